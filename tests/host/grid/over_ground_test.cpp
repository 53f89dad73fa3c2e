// Lidars that follow the ground (docs/ground.md), against the rule worked out once more: fates by a
// second implementation, exits by exact whole numbers, each cell by exact shares of its line.
#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/fake_packet.hpp"
#include "fakes/ground_car.hpp"
#include "fakes/ground_surfaces.hpp"
#include "fakes/ground_turns.hpp"
#include "fakes/low_and_tall.hpp"
#include "fakes/random.hpp"
#include "fakes/reference_tilt.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/turning_rule.hpp"
#include "fusion/frame_fusion.hpp"
#include "ground/ground.hpp"

namespace iog::grid {
namespace {

using fusion::FrameFusion;
using geometry::Cell;
using lidar::ScanPoint;
using tests::FakePacket;
using tests::fate_at;
using tests::kLimits;
using tests::LevelVlp16;
using tests::ManyLayers;
using tests::Random;
using tests::Surfaces;
using tests::TurningRay;
using tests::Whole;
using vehicle::Fate;

constexpr vehicle::MovedLimits kMoved{.low_mm = 600, .tall_mm = 600};
constexpr vehicle::MovedLimits kBeginsLow{.low_mm = 2'000, .tall_mm = 600};

// A point as both implementations see it.
struct Place {
  Whole sector = 0;
  Whole along_mm = 0;
  Whole z_mm = 0;
};

// The last of 0, 2, 4 ... mm up to which a beam is between the limits over the reference's ground.
// In units of 2^-24 mm, times the length of a bin: below 2^62.
std::int64_t exit_of(const ground::Beams& beams, const std::vector<Whole>& row, std::size_t layer,
                     vehicle::GroundLimits limits = kLimits) {
  const std::int64_t length = beams.bins().length_mm();
  const auto fine = [&](std::int64_t mm) { return mm * length * (1 << 24); };
  std::int64_t to = -2;
  for (std::int64_t along = 0; along <= beams.range_mm(); along += 2) {
    const std::int64_t bin = std::min<std::int64_t>(along / length, 63);
    const std::int64_t start = row[static_cast<std::size_t>(bin)];
    const std::int64_t rise = row[static_cast<std::size_t>(bin) + 1] - start;
    const std::int64_t over = fine(beams.origin_mm() - start) +
                              std::int64_t{beams.slope(layer)} * along * length -
                              rise * (along - bin * length) * (1 << 24);
    if (over < fine(limits.low_mm) || fine(limits.top_mm) < over) {
      break;
    }
    to = along;
  }
  return std::max<std::int64_t>(to, 0);
}

template <typename Car>
class AlonePoints {
 public:
  AlonePoints(std::span<const double> elevations_deg, Random& random)
      : random_(random),
        rule_(Car::kConfigs[0], Car::kDescription, elevations_deg),
        surfaces_(std::make_unique<Surfaces>(
            car_.vehicle(), 0,
            tests::rough_turn(
                random, static_cast<std::int32_t>(ground::Bins(sensor().range.mm()).length_mm())))),
        beams_(tests::ground_of(surfaces_->grounds, 0).beams()) {
    fusion_->follow(surfaces_->grounds);
  }

  // Of a packet with samples that lie along a tilt, or with none.
  void expect_as_the_rule_says(const ScanPoint& point) {
    const std::optional<TurningRay> ray = rule_.ray(point);
    if (!ray) {
      return;
    }
    const FakePacket packet{.points = {point}, .samples = samples_around(point)};
    const tests::ReferenceTilt tilt = tilt_of(packet.samples);
    tilted_ += tilt.up_mm != 0 || tilt.slope != 0 ? 1 : 0;
    Fate expected = rule_.fate(*ray, point);
    const Place place = place_of(point);
    if (expected == Fate::kUsed || expected == Fate::kOutsideHeightBand) {
      expected = fate_at(over(place) - tilt.at(place.along_mm));
    }
    Fate fate = Fate::kMalformed;
    fusion_->add_all(sensor(), packet, [&](Fate its) { fate = its; });
    fusion_->finish();
    ASSERT_EQ(fate, expected) << point.range_mm << ", " << point.azimuth_ticks;
    ++fates_[static_cast<std::size_t>(fate)];
    expect_cells(*ray, point, fate,
                 exit_of(beams_, surfaces_->reference.row(place.sector), point.layer));
    expect_heights(*ray, point, place, over_near(place) - tilt.at(place.along_mm));
    fusion_->clear();
  }

  [[nodiscard]] int count(Fate fate) const { return fates_[static_cast<std::size_t>(fate)]; }
  [[nodiscard]] int tilted() const { return tilted_; }
  [[nodiscard]] int lows() const { return lows_; }
  [[nodiscard]] int talls() const { return talls_; }

 private:
  [[nodiscard]] const vehicle::Sensor& sensor() const { return car_.vehicle().sensors[0]; }

  [[nodiscard]] Place place_of(const ScanPoint& point) const {
    const std::uint32_t step = sensor().azimuths.nearest(point.azimuth_ticks);
    const Whole along_mm = rule_.along(point, point.range_mm);
    return {
        .sector = beams_.sector_of(step),
        .along_mm = along_mm,
        .z_mm = beams_.height_mm(beams_.slope(point.layer), static_cast<std::uint32_t>(along_mm))};
  }
  [[nodiscard]] Whole over(const Place& place) const {
    return surfaces_->reference.height_over(place.sector, place.along_mm, place.z_mm);
  }
  [[nodiscard]] Whole over_near(const Place& place) const {
    return surfaces_->reference.height_over_near(place.sector, place.along_mm, place.z_mm);
  }

  // Returns of layers that look down, of the distance at which they meet ground that is tilted.
  std::vector<ScanPoint> samples_around(const ScanPoint& point) {
    std::vector<ScanPoint> samples;
    if (random_.one_in(3)) {
      return samples;
    }
    const double slope = random_.between(-30, 30) / 1000.0;
    for (int i = 0; i < 8'000 && samples.size() < 44; ++i) {
      ScanPoint sample = point;
      sample.layer = static_cast<std::uint8_t>(random_.below(sensor().layer_count));
      sample.range_mm = static_cast<std::uint32_t>(random_.between(1'000, 31'000));
      const Place place = place_of(sample);
      const double off =
          static_cast<double>(over(place)) - slope * static_cast<double>(place.along_mm);
      if (std::abs(off) < 150 && rule_.ray(sample)) {
        samples.push_back(sample);
      }
    }
    return samples;
  }

  [[nodiscard]] tests::ReferenceTilt tilt_of(const std::vector<ScanPoint>& samples) const {
    std::vector<tests::ReferenceSample> heights;
    for (const ScanPoint& its : samples) {
      if (rule_.fate(*rule_.ray(its), its) != Fate::kTooNear) {
        const Place place = place_of(its);
        heights.push_back({place.along_mm, over(place)});
      }
    }
    return tests::ReferenceLine().of(heights, sensor().layer_count <= 16 ? 12 : 24);
  }

  // All cells that the line might touch, and no others.
  void expect_cells(const TurningRay& ray, const ScanPoint& point, Fate fate, std::int64_t to_mm) {
    std::ptrdiff_t known = 0;
    tests::for_each_cell_around(ray, [&](Cell cell) {
      const int found = fusion_->view().at(cell);
      known += found != 0 ? 1 : 0;
      ASSERT_EQ(found, rule_.index(sensor().profile, ray, point, fate, cell, to_mm))
          << "cell " << cell.x << ", " << cell.y << ", range " << point.range_mm << ", tick "
          << point.azimuth_ticks << ", layer " << int{point.layer} << ", to " << to_mm;
    });
    const auto cells = tests::cells_of(*fusion_);
    ASSERT_EQ(std::ssize(cells) - std::ranges::count(cells, 0), known);
  }

  // The beam is low from where it is no more than that over the lowest ground nearby up to where it
  // leaves the limits, or might pass under a car. A hit is tall by the highest ground nearby.
  void expect_heights(const TurningRay& ray, const ScanPoint& point, const Place& place,
                      Whole hit_mm) {
    const std::vector<Whole> lowest = surfaces_->reference.lowest_near(place.sector);
    const std::vector<Whole>& own = surfaces_->reference.row(place.sector);
    const std::int64_t from_mm = exit_of(beams_, lowest, point.layer, {kMoved.low_mm, 65'535});
    const std::int64_t to_mm = exit_of(beams_, own, point.layer, {300, kLimits.top_mm});
    const auto line_mm = static_cast<std::int64_t>(beams_.range_mm());
    const lab::reference::Rational from{from_mm, line_mm};
    const lab::reference::Rational to{to_mm, line_mm};
    tests::for_each_cell_around(ray, [&](Cell cell) {
      const int index = fusion_->view().at(cell);
      const auto crossing = lab::reference::cross(ray.start, ray.end, cell, geometry::kResolution);
      const bool is_low = from_mm < to_mm && index < 0 && crossing && from < crossing->leave &&
                          !(to < crossing->enter);
      const bool is_tall = index > 0 && hit_mm >= kMoved.tall_mm && std::abs(place.z_mm) <= 3'000;
      lows_ += is_low ? 1 : 0;
      talls_ += is_tall ? 1 : 0;
      ASSERT_EQ(tests::low_or_tall(*fusion_, cell), is_low || is_tall)
          << "cell " << cell.x << ", " << cell.y << ", index " << index << ", range "
          << point.range_mm << ", tick " << point.azimuth_ticks << ", layer " << int{point.layer};
    });
  }

  Random& random_;
  tests::GroundCar car_{Car::kVehicle, kLimits, kMoved};
  tests::TurningRule rule_;
  std::unique_ptr<Surfaces> surfaces_;
  const ground::Beams& beams_;
  std::unique_ptr<FrameFusion> fusion_ = std::make_unique<FrameFusion>(car_.vehicle());
  std::array<int, vehicle::kFateCount> fates_{};
  int tilted_ = 0;
  int lows_ = 0;
  int talls_ = 0;
};

template <typename Car>
void expect_every_cell_as_the_rule_says(std::span<const double> elevations_deg, std::uint64_t seed,
                                        int points) {
  Random random(seed);
  AlonePoints<Car> alone(elevations_deg, random);
  const int longest_mm = static_cast<int>(Car::kConfigs[0].range_max_mm) * 9 / 8;
  for (int i = 0; i < points && !testing::Test::HasFatalFailure(); ++i) {
    alone.expect_as_the_rule_says(tests::random_point(random, elevations_deg.size(), longest_mm));
  }
  for (const Fate fate : {Fate::kUsed, Fate::kGround, Fate::kOverhang, Fate::kUnderGround}) {
    EXPECT_GT(alone.count(fate), 0) << static_cast<int>(fate);
  }
  EXPECT_EQ(alone.count(Fate::kOutsideHeightBand), 0);
  EXPECT_GT(std::min({alone.tilted(), alone.lows(), alone.talls()}), 0);
}

TEST(OverGround, EveryCellIsAsTheRuleSaysForAVlp16) {
  expect_every_cell_as_the_rule_says<LevelVlp16>(lidar::VelodyneVlp16::kElevationsDeg, 61,
                                                 tests::effort(240, 60));
}
TEST(OverGround, EveryCellIsAsTheRuleSaysFor128Layers) {
  expect_every_cell_as_the_rule_says<ManyLayers>(ManyLayers::kElevationsDeg, 62,
                                                 tests::effort(240, 60));
}

// Points of one packet, close together, of all fates and echoes.
FakePacket random_packet(Random& random, std::size_t layers, int points) {
  FakePacket packet;
  for (int i = 0; i < points; ++i) {
    ScanPoint point = tests::random_point(random, layers, 40'000);
    point.azimuth_ticks = static_cast<std::uint16_t>(random.below(100));
    point.echo = random.one_in(8) ? std::uint8_t{1} : std::uint8_t{0};
    packet.points.push_back(point);
  }
  packet.samples.assign(packet.points.begin(), packet.points.begin() + 44);
  return packet;
}

// Beams of a line wait for one another, and those that end behind the limits only as ranks of their
// sector; what they carve is what each carves at once, and their lows are the same.
TEST(OverGround, NeitherWaitingNorSparingABeamShows) {
  Random random(63);
  for (int i = 0; i < 4; ++i) {
    const vehicle::Vehicle& car = i % 2 == 0 ? LevelVlp16::kVehicle : ManyLayers::kVehicle;
    const tests::GroundCar ground_car(car, kLimits, i < 2 ? kMoved : kBeginsLow);
    const vehicle::Vehicle& its = ground_car.vehicle();
    const auto waits = std::make_unique<FrameFusion>(its);
    for (int frame = 0; frame < 3; ++frame) {
      const auto surfaces = std::make_unique<Surfaces>(its, 0, tests::rough_turn(random, 1'024));
      const auto alone = std::make_unique<FrameFusion>(its);
      waits->follow(surfaces->grounds);
      alone->follow(surfaces->grounds);
      const FakePacket packet =
          random_packet(random, its.sensors[0].layer_count, tests::effort(4'000, 400));
      std::vector<Fate> fates;
      waits->add_all(its.sensors[0], packet, [&](Fate fate) { fates.push_back(fate); });
      for (std::size_t number = 0; number < packet.points.size(); ++number) {
        const FakePacket one{.points = {packet.points[number]}, .samples = packet.samples};
        alone->add_all(its.sensors[0], one, [&](Fate fate) { ASSERT_EQ(fate, fates[number]); });
        alone->carve_waiting();
      }
      waits->finish();
      alone->finish();
      EXPECT_EQ(tests::cells_of(*waits), tests::cells_of(*alone)) << car.name;
      EXPECT_EQ(tests::low_and_tall_of(*waits), tests::low_and_tall_of(*alone)) << car.name;
      EXPECT_TRUE(waits->lows(0) == alone->lows(0));
      waits->clear();
      waits->lows(0).clear();
    }
  }
}

// The lows are those of all that comes back from beside the car, whatever becomes of it.
TEST(OverGround, LowsAreOfEveryReturn) {
  Random random(64);
  const tests::GroundCar car(LevelVlp16::kVehicle, kLimits);
  const vehicle::Sensor& sensor = car.vehicle().sensors[0];
  const auto surfaces =
      std::make_unique<Surfaces>(car.vehicle(), 0, tests::rough_turn(random, 1'024));
  const auto fusion = std::make_unique<FrameFusion>(car.vehicle());
  fusion->follow(surfaces->grounds);
  const FakePacket packet = random_packet(random, 16, 2'000);
  const ground::Beams& beams = tests::ground_of(surfaces->grounds, 0).beams();
  ground::Lows expected;
  std::size_t number = 0;
  fusion->add_all(sensor, packet, [&](Fate fate) {
    const ScanPoint& point = packet.points[number++];
    if (fate != Fate::kNoReturn && fate != Fate::kTooNear) {
      const std::uint32_t along_mm = sensor.layers[point.layer].along_line_mm(point.range_mm);
      expected.add(beams.bins(), beams.sector_of(sensor.azimuths.nearest(point.azimuth_ticks)),
                   along_mm, beams.height_mm(beams.slope(point.layer), along_mm));
    }
  });
  EXPECT_TRUE(fusion->lows(0) == expected);
  EXPECT_FALSE(expected == ground::Lows());
}

}  // namespace
}  // namespace iog::grid
