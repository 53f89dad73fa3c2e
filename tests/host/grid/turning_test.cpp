// Level lidars that turn (docs/model.md section 5), against the rule worked out from metres and
// degrees.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/compiled_car.hpp"
#include "fakes/effort.hpp"
#include "fakes/fake_packet.hpp"
#include "fakes/ground_car.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/turning_rule.hpp"
#include "fusion/frame_fusion.hpp"
#include "ground/ground.hpp"

namespace iog::grid {
namespace {

using tests::LevelVlp16;
using tests::ManyLayers;
using tests::random_point;
using tests::SteepVlp16;
using tests::TurningRay;
using tests::TurningRule;
using vehicle::Fate;

// One point after the other, each in a frame of its own.
class AlonePoints {
 public:
  AlonePoints(const TurningRule& rule, const vehicle::Vehicle& car) : rule_(rule), car_(car) {}

  // All cells that the line might touch, and no others.
  void expect_as_the_rule_says(const lidar::ScanPoint& point) {
    const std::optional<TurningRay> ray = rule_.ray(point);
    if (!ray) {
      return;
    }
    const vehicle::Sensor& sensor = car_.sensors[0];
    const Fate fate = fusion_->add(sensor, point);
    fusion_->finish();
    ASSERT_EQ(fate, rule_.fate(*ray, point)) << words_of(point);
    ++fates_[static_cast<std::size_t>(fate)];
    std::ptrdiff_t known = 0;
    const auto expect_cell = [&](geometry::Cell cell) {
      const int found = fusion_->view().at(cell);
      known += found != 0 ? 1 : 0;
      ASSERT_EQ(found, rule_.index(sensor.profile, *ray, point, fate, cell))
          << "cell " << cell.x << ", " << cell.y << ", " << words_of(point);
    };
    tests::for_each_cell_around(*ray, expect_cell, car_.grid.area());
    const auto cells = tests::cells_of(*fusion_);
    ASSERT_EQ(std::ssize(cells) - std::ranges::count(cells, 0), known);
    fusion_->clear();
  }

  [[nodiscard]] int count(Fate fate) const { return fates_[static_cast<std::size_t>(fate)]; }

 private:
  static std::string words_of(const lidar::ScanPoint& point) {
    return "range " + std::to_string(point.range_mm) + ", tick " +
           std::to_string(point.azimuth_ticks) + ", layer " + std::to_string(point.layer);
  }

  TurningRule rule_;
  vehicle::Vehicle car_;
  std::unique_ptr<fusion::FrameFusion> fusion_ = std::make_unique<fusion::FrameFusion>(car_);
  std::array<int, vehicle::kFateCount> fates_{};
};

void expect_every_cell_as_the_rule_says(AlonePoints& alone, std::size_t layers, int longest_mm,
                                        std::uint64_t seed, int points) {
  tests::Random random(seed);
  for (int i = 0; i < points && !testing::Test::HasFatalFailure(); ++i) {
    alone.expect_as_the_rule_says(random_point(random, layers, longest_mm));
  }
  EXPECT_GT(alone.count(Fate::kUsed), 0);
  EXPECT_GT(alone.count(Fate::kOutsideHeightBand), 0);
}

template <typename Car>
AlonePoints alone_points(std::span<const double> elevations_deg) {
  return {TurningRule(Car::kConfigs[0], Car::kDescription, elevations_deg), Car::kVehicle};
}

template <typename Car>
void expect_every_cell_as_the_rule_says(std::span<const double> elevations_deg, std::uint64_t seed,
                                        int points) {
  AlonePoints alone = alone_points<Car>(elevations_deg);
  const int longest_mm = static_cast<int>(Car::kConfigs[0].range_max_mm) * 9 / 8;
  expect_every_cell_as_the_rule_says(alone, elevations_deg.size(), longest_mm, seed, points);
}

TEST(Turning, EveryCellIsAsTheRuleSaysForAVlp16) {
  expect_every_cell_as_the_rule_says<LevelVlp16>(lidar::VelodyneVlp16::kElevationsDeg, 51,
                                                 tests::effort(120, 8));
}
TEST(Turning, EveryCellIsAsTheRuleSaysFor128Layers) {
  expect_every_cell_as_the_rule_says<ManyLayers>(ManyLayers::kElevationsDeg, 52,
                                                 tests::effort(120, 8));
}

TEST(Turning, EveryCellIsAsTheRuleSaysAtTheLimits) {
  expect_every_cell_as_the_rule_says<SteepVlp16>(SteepVlp16::kElevationsDeg, 53,
                                                 tests::effort(60, 8));
}

TEST(Turning, EveryCellIsAsTheRuleSaysOnEachGrid) {
  std::uint64_t seed = 55;
  for (const description::GridConfig& grid : tests::kOtherGrids) {
    const tests::CarOn<LevelVlp16> car(grid);
    AlonePoints alone(
        TurningRule(car.configs[0], car.description, lidar::VelodyneVlp16::kElevationsDeg),
        car.compiled.vehicle);
    const int longest_mm = static_cast<int>(car.configs[0].range_max_mm) * 9 / 8;
    expect_every_cell_as_the_rule_says(alone, 16, longest_mm, seed++, tests::effort(60, 8));
  }
}

// Where the car's own border lies is asked of what was measured, as the sensor's minimum is, and
// not of how far along the line that is: steep layers would show it.
TEST(Turning, TooNearIsJudgedByWhatIsMeasured) {
  const TurningRule rule(LevelVlp16::kConfigs[0], LevelVlp16::kDescription,
                         lidar::VelodyneVlp16::kElevationsDeg);
  const vehicle::Sensor& sensor = LevelVlp16::kVehicle.sensors[0];
  int on_border = 0;
  for (const std::uint16_t tick : std::to_array<std::uint16_t>({0, 4'507, 9'001, 18'000, 27'013})) {
    for (std::uint32_t range_mm = 1; range_mm < 6'000; ++range_mm) {
      const lidar::ScanPoint point{.range_mm = range_mm, .azimuth_ticks = tick, .layer = 0};
      const vehicle::Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
      const Fate fate = vehicle::classify(sensor, beam, point).fate;
      const std::optional<TurningRay> ray = rule.ray(point);
      ASSERT_TRUE(ray);
      ASSERT_EQ(fate, rule.fate(*ray, point)) << tick << ", " << range_mm;
      on_border += fate == Fate::kTooNear && range_mm >= sensor.range_min_mm ? 1 : 0;
    }
  }
  EXPECT_GT(on_border, 0);
}

// Where a point comes to lie behind the end of the band, the zones before it leave the band one
// after the other, until all of the part inside is free.
TEST(Turning, EveryCellIsAsTheRuleSaysBehindTheBand) {
  constexpr int kStepMm = tests::effort(41, 163);
  tests::Random random(54);
  AlonePoints alone = alone_points<LevelVlp16>(lidar::VelodyneVlp16::kElevationsDeg);
  const auto sensor_m = static_cast<long double>(LevelVlp16::kConfigs[0].mount.z_m);
  // Steps of 5 have layers above and below by turns.
  constexpr std::size_t kLayerStep = tests::effort(1, 5);
  for (std::size_t layer = 0; layer < lidar::VelodyneVlp16::kElevationsDeg.size();
       layer += kLayerStep) {
    const long double elevation = tests::radians(lidar::VelodyneVlp16::kElevationsDeg[layer]);
    const description::Description& car = LevelVlp16::kDescription;
    const auto limit_m = static_cast<long double>(elevation < 0 ? car.z_min_m : car.z_max_m);
    const auto end_mm = static_cast<int>(1000 * (limit_m - sensor_m) / std::sin(elevation));
    for (int range_mm = end_mm - 50; range_mm < end_mm + 600 && !HasFatalFailure();
         range_mm += kStepMm) {
      alone.expect_as_the_rule_says(
          {.range_mm = static_cast<std::uint32_t>(range_mm),
           .azimuth_ticks = static_cast<std::uint16_t>(random.between(0, 35'999)),
           .layer = static_cast<std::uint8_t>(layer)});
    }
  }
  EXPECT_GT(alone.count(Fate::kOutsideHeightBand), 5);
}

// Less than a millimetre along its line, there is nothing before a point to carve: it marks the
// cell of the sensor, whether heights are over the ground or over the car's plane.
TEST(Turning, APointAtTheSensorMarksAndCarvesNothing) {
  std::vector<vehicle::Sensor> sensors(1, ManyLayers::kVehicle.sensors[0]);
  sensors[0].range_min_mm = 0;
  vehicle::Vehicle car = ManyLayers::kVehicle;
  car.sensors = sensors;
  const tests::GroundCar over_ground(car);
  const auto grounds = std::make_unique<ground::Grounds>(over_ground.vehicle());
  for (const bool is_followed : {false, true}) {
    const vehicle::Vehicle& its = is_followed ? over_ground.vehicle() : car;
    const auto fusion = std::make_unique<fusion::FrameFusion>(its);
    if (is_followed) {
      fusion->follow(*grounds);
    }
    const tests::FakePacket packet{.points = {{.range_mm = 1, .layer = 0}}, .samples = {}};
    fusion->add_all(its.sensors[0], packet, [](Fate fate) { EXPECT_EQ(fate, Fate::kUsed); });
    fusion->finish();
    // 0.123 m ahead and 0.456 m to the left of the middle.
    EXPECT_EQ(fusion->view().at({513, 516}), its.sensors[0].profile.hit);
    const auto cells = tests::cells_of(*fusion);
    EXPECT_EQ(std::ssize(cells) - std::ranges::count(cells, 0), 1);
  }
}

// Beams of a line wait for one another, several azimuths at a time, and their lines are kept from
// frame to frame; what they carve is what each carves at once, on lines that a new fusion finds.
TEST(Turning, NeitherWaitingNorKeepingALineShows) {
  tests::Random random(53);
  for (const vehicle::Vehicle& car :
       {LevelVlp16::kVehicle, ManyLayers::kVehicle, tests::MixedCar::kVehicle}) {
    const auto waits = std::make_unique<fusion::FrameFusion>(car);
    for (int frame = 0; frame < 3; ++frame) {
      const auto alone = std::make_unique<fusion::FrameFusion>(car);
      for (int i = 0; i < tests::effort(2'000, 100); ++i) {
        // Close together, and the sensors by turns, each for a while.
        const vehicle::Sensor& sensor =
            car.sensors[static_cast<std::size_t>(i / 50) % car.sensors.size()];
        lidar::ScanPoint point = random_point(random, sensor.layer_count, 40'000);
        point.azimuth_ticks = static_cast<std::uint16_t>(random.below(100));
        point.echo = random.one_in(8) ? std::uint8_t{1} : std::uint8_t{0};
        const Fate fate = waits->add(sensor, point);
        ASSERT_EQ(alone->add(sensor, point), fate);
        alone->carve_waiting();
      }
      waits->finish();
      alone->finish();
      ASSERT_EQ(tests::cells_of(*waits), tests::cells_of(*alone)) << car.name;
      waits->clear();
    }
  }
}

}  // namespace
}  // namespace iog::grid
