// A tilted lidar that follows the ground (docs/ground.md): fates by a second implementation, each
// cell by exact shares of its line up to the beam's exit.
#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/fake_packet.hpp"
#include "fakes/ground_car.hpp"
#include "fakes/ground_surfaces.hpp"
#include "fakes/ground_turns.hpp"
#include "fakes/random.hpp"
#include "fakes/reference_tilt.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/turning_rule.hpp"
#include "fusion/frame_fusion.hpp"
#include "ground/ground.hpp"

namespace iog::grid {
namespace {

using fusion::FrameFusion;
using lidar::ScanPoint;
using tests::FakePacket;
using tests::MixedCar;
using tests::Random;
using tests::Whole;
using vehicle::Fate;

// How far out a return is, and how high over the reference's ground.
struct Over {
  Whole out_mm;
  Whole height_mm;
};

class TiltedPoints {
 public:
  explicit TiltedPoints(Random& random) : random_(random) { fusion_->follow(surfaces_->grounds); }

  void expect_as_the_rule_says(const ScanPoint& point, bool leans) {
    tests::ReferenceTilt tilt;
    const FakePacket packet{.points = {point}, .samples = samples(leans, tilt)};
    leaning_ += tilt.up_mm != 0 || tilt.slope != 0 ? 1 : 0;
    const Fate by_band = flat_->add(sensor_, point);
    Fate fate = Fate::kMalformed;
    fusion_->add_all(sensor_, packet, [&](Fate its) { fate = its; });
    flat_->finish();
    fusion_->finish();
    ++fates_[static_cast<std::size_t>(fate)];
    if (by_band == Fate::kUsed || by_band == Fate::kOutsideHeightBand) {
      const Over its = over(point);
      ASSERT_EQ(fate, tests::fate_at(its.height_mm - tilt.at(its.out_mm)));
    } else {
      ASSERT_EQ(fate, by_band);
    }
    expect_cells(point, fate);
    fusion_->clear();
    flat_->clear();
  }

  [[nodiscard]] int count(Fate fate) const { return fates_[static_cast<std::size_t>(fate)]; }
  [[nodiscard]] int leaning() const { return leaning_; }
  // Cells that a beam would have freed in the height band.
  [[nodiscard]] int left_out() const { return left_out_; }

 private:
  static constexpr std::size_t kTilted = 1;

  [[nodiscard]] std::uint32_t sector_of(const ScanPoint& point) const {
    return ground_.beams().sector_of(sensor_.azimuths.nearest(point.azimuth_ticks));
  }
  [[nodiscard]] vehicle::Beam beam_of(const ScanPoint& point) const {
    return vehicle::aim(sensor_, point.layer, point.azimuth_ticks);
  }
  [[nodiscard]] Over over(const ScanPoint& point) const {
    const ground::Beams& beams = ground_.beams();
    const Whole out_mm = beams.out_mm(point.layer, point.range_mm);
    const Whole z_mm = beams.height_mm(beams.slope_to(beam_of(point).end_z), point.range_mm);
    return {.out_mm = out_mm,
            .height_mm = surfaces_->reference.height_over(sector_of(point), out_mm, z_mm)};
  }

  // Of a car that leans, they lie along a slope of 2 %.
  std::vector<ScanPoint> samples(bool leans, tests::ReferenceTilt& tilt) {
    std::vector<ScanPoint> found;
    std::vector<tests::ReferenceSample> heights;
    for (int n = 0; n < 4'000 && leans && found.size() < 44; ++n) {
      ScanPoint sample = tests::random_point(random_, 16, 31'000);
      sample.range_mm += 1'000;
      const Over its = over(sample);
      if (std::abs(its.height_mm - its.out_mm / 50) < 150) {
        found.push_back(sample);
        heights.push_back({its.out_mm, its.height_mm});
      }
    }
    tilt = tests::ReferenceLine().of(heights, 12);
    return found;
  }

  [[nodiscard]] tests::TurningRay ray_of(const vehicle::BeamLine& line) const {
    const auto end = [](const auto& axis, std::int32_t start) {
      return start + axis.step() * static_cast<std::int32_t>(axis.length());
    };
    return {.start = sensor_.origin,
            .end = {end(line.x(), sensor_.origin.x), end(line.y(), sensor_.origin.y)}};
  }

  // All cells that the line might touch, and no others.
  void expect_cells(const ScanPoint& point, Fate fate) {
    const std::uint32_t exit_mm = ground_.exits().to_mm(sector_of(point), point.layer);
    const tests::TurningRay ray = ray_of(beam_of(point).line);
    std::ptrdiff_t known = 0;
    tests::for_each_cell_around(ray, [&](geometry::Cell cell) {
      const int found = fusion_->view().at(cell);
      known += found != 0 ? 1 : 0;
      left_out_ += flat_->view().at(cell) < 0 && found == 0 ? 1 : 0;
      ASSERT_EQ(found, rule_.index(sensor_.profile, ray, point, fate, cell, exit_mm))
          << "cell " << cell.x << ", " << cell.y << ", range " << point.range_mm << ", tick "
          << point.azimuth_ticks << ", layer " << int{point.layer} << ", to " << exit_mm;
    });
    const auto cells = tests::cells_of(*fusion_);
    ASSERT_EQ(std::ssize(cells) - std::ranges::count(cells, 0), known);
  }

  Random& random_;
  tests::GroundCar car_{MixedCar::kVehicle, tests::kLimits};
  const vehicle::Sensor& sensor_ = car_.vehicle().sensors[kTilted];
  std::unique_ptr<tests::Surfaces> surfaces_ =
      std::make_unique<tests::Surfaces>(car_.vehicle(), kTilted, tests::rough_turn(random_, 1'024));
  const ground::Ground& ground_ = tests::ground_of(surfaces_->grounds, kTilted);
  tests::TurningRule rule_{MixedCar::kConfigs[kTilted], MixedCar::kDescription, {}, true};
  std::unique_ptr<FrameFusion> fusion_ = std::make_unique<FrameFusion>(car_.vehicle());
  std::unique_ptr<FrameFusion> flat_ = std::make_unique<FrameFusion>(car_.vehicle());
  std::array<int, vehicle::kFateCount> fates_{};
  int leaning_ = 0;
  int left_out_ = 0;
};

TEST(OverGround, ATiltedUnitMarksAndCarvesByTheGround) {
  Random random(65);
  TiltedPoints points(random);
  for (int i = 0; i < tests::effort(400, 100) && !testing::Test::HasFatalFailure(); ++i) {
    points.expect_as_the_rule_says(tests::random_point(random, 16, 60'000), i % 8 == 0);
  }
  for (const Fate fate : {Fate::kUsed, Fate::kGround, Fate::kOverhang, Fate::kUnderGround}) {
    EXPECT_GT(points.count(fate), 0) << static_cast<int>(fate);
  }
  EXPECT_GT(std::min(points.leaning(), points.left_out()), 0);
}

}  // namespace
}  // namespace iog::grid
