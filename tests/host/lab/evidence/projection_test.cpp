// Evidence that is projected and fused by the rules of docs/model.md is the firmware's grid, byte
// for byte: what experiments change is changed against that, and against nothing else.
#include "lab/evidence/projection.hpp"

#include <gtest/gtest.h>
#include <memory>

#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"
#include "lab/evidence/fusion_rules.hpp"
#include "lab/evidence/values.hpp"
#include "vehicles/cars.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;
using vehicle::FusionRule;
using vehicle::Vehicle;

constexpr sensor_model::Profile kBlurring = sensor_model::make_profile({});
constexpr sensor_model::Profile kNearest =
    sensor_model::make_profile({.quantisation = Quantisation::kNearest});

// A vehicle whose quantisation and rule are not those of its description.
struct Variant {
  Variant(const Vehicle& from, Quantisation policy, FusionRule rule)
      : sensors(from.sensors.begin(), from.sensors.end()), vehicle(from), quantisation(policy) {
    for (vehicle::Sensor& sensor : sensors) {
      sensor.profile = policy == Quantisation::kBlurring ? kBlurring : kNearest;
    }
    vehicle.sensors = sensors;
    vehicle.rule = rule;
  }

  std::vector<vehicle::Sensor> sensors;
  Vehicle vehicle;
  Quantisation quantisation;
};

// How many cells of these frames differ from the firmware's, at most some million.
long cells_that_differ(const Variant& variant, const std::vector<FramePoints>& frames) {
  const auto values = indexes(probabilities({}), 0.05, variant.quantisation);
  const IndexRule rule =
      variant.vehicle.rule == FusionRule::kHitsWin ? IndexRule::kHitsWin : IndexRule::kBayes;
  const auto fusion = std::make_unique<fusion::FrameFusion>(variant.vehicle);
  long differ = 0;
  for (const FramePoints& points : frames) {
    fusion->clear();
    for (const SensorPoint& seen : points) {
      fusion->add(variant.sensors[seen.sensor], seen.point);
    }
    fusion->finish();
    const auto cells = fuse_indexes(project(variant.vehicle, points), values, rule, 127);
    for (std::size_t i = 0; i < geometry::kCellCount; ++i) {
      differ += cells[i] == fusion->view().at(geometry::cell_of(i)) ? 0 : 1;
    }
  }
  return differ;
}

void expect_the_firmwares_grids(const Vehicle& vehicle, const std::vector<FramePoints>& frames) {
  for (const Quantisation policy : {Quantisation::kBlurring, Quantisation::kNearest}) {
    for (const FusionRule rule : {FusionRule::kHitsWin, FusionRule::kBayes}) {
      EXPECT_EQ(cells_that_differ({vehicle, policy, rule}, frames), 0)
          << vehicle.name << ", policy " << int(policy) << ", rule " << int(rule);
    }
  }
}

std::vector<FramePoints> frames_of_drive(const tools::CatalogueEntry& car, std::uint64_t seed,
                                         std::uint32_t every) {
  tools::Drive drive(car, seed, 1);
  std::vector<FramePoints> frames;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += every) {
    frames.push_back(points_of(drive, frame, car));
  }
  return frames;
}

class DriveOfSeed : public testing::TestWithParam<std::uint64_t> {};

TEST_P(DriveOfSeed, OfTheReferenceCarIsTheFirmwaresGrid) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  expect_the_firmwares_grids(*car.vehicle, frames_of_drive(car, GetParam(), 9));
}
TEST_P(DriveOfSeed, OfTwoLuxIsTheFirmwaresGrid) {
  const tools::CatalogueEntry& car = tools::find_vehicle("two_lux_parking");
  expect_the_firmwares_grids(*car.vehicle, frames_of_drive(car, GetParam(), 9));
}
INSTANTIATE_TEST_SUITE_P(Projection, DriveOfSeed, testing::Values(1, 7, 2017));

// Ranges from beside the car to far beyond the model's, missing returns, ground, later echoes, and
// scan points on the borders of 1D cells and at the range itself.
FramePoints random_points(const Vehicle& vehicle, std::uint64_t seed, int count) {
  tests::Random random(seed);
  FramePoints points;
  for (int i = 0; i < count; ++i) {
    const std::size_t place = random.below(vehicle.sensors.size());
    const vehicle::Sensor& sensor = vehicle.sensors[place];
    const auto turn = static_cast<int>(sensor.azimuths.ticks_per_turn());
    const auto range_mm = static_cast<int>(sensor.range.mm());
    lidar::ScanPoint point;
    point.azimuth_ticks = static_cast<std::uint16_t>(
        random.one_in(5) ? random.between(0, 7) * turn / 8 : random.between(0, turn - 1));
    point.layer = static_cast<std::uint8_t>(random.between(0, sensor.layer_count - 1));
    point.range_mm =
        static_cast<std::uint32_t>(random.one_in(10)  ? 0
                                   : random.one_in(4) ? random.between(1, range_mm / 100) * 100
                                                      : random.between(1, range_mm * 5 / 4));
    point.range_mm = random.one_in(30) ? sensor.range.mm() : point.range_mm;
    point.echo = random.one_in(6) ? std::uint8_t{1} : std::uint8_t{0};
    point.is_ground = random.one_in(15);
    points.push_back({place, point});
  }
  return points;
}

TEST(Projection, RandomPointsInAHeightBandAreTheFirmwaresGrid) {
  const Vehicle& vehicle = tests::TiltedLux::kVehicle;
  expect_the_firmwares_grids(vehicle, {random_points(vehicle, 1, 4000)});
}
TEST(Projection, RandomPointsFromOutsideTheGridAreTheFirmwaresGrid) {
  const Vehicle& vehicle = tests::ThreeLux::kVehicle;
  expect_the_firmwares_grids(vehicle, {random_points(vehicle, 2, 4000)});
}
// A sensor on a cell's corner: half of the beams start on borders that they cross at once.
TEST(Projection, RandomPointsFromACornerAreTheFirmwaresGrid) {
  const Vehicle& vehicle = tests::OneLux::kVehicle;
  expect_the_firmwares_grids(vehicle, {random_points(vehicle, 3, 4000)});
}
TEST(Projection, RandomPointsOfAVlp16AreTheFirmwaresGrid) {
  const Vehicle& vehicle = vehicles::car("roof_vlp16").vehicle;
  expect_the_firmwares_grids(vehicle, {random_points(vehicle, 4, 4000)});
}

// docs/model.md section 6, whatever the sampling: a beam that only carves marks nothing, a later
// echo carves nothing.
TEST(Projection, NoSamplingGivesAPointMoreThanItsFateAllows) {
  const Vehicle& vehicle = tests::OneLux::kVehicle;
  for (const Sampling sampling : {Sampling::kModel, Sampling::kCentre}) {
    const auto of = [&](lidar::ScanPoint point) {
      return project(vehicle, {{0, point}}, sampling);
    };
    const auto ground = of({.range_mm = 20'000, .azimuth_ticks = 333, .is_ground = true});
    EXPECT_GT(ground.cells.size(), 150U);
    EXPECT_TRUE(ground.hits.empty());
    for (const CellEvidence& seen : ground.cells) {
      EXPECT_LT(seen.step, 0);
    }
    const auto later = of({.range_mm = 20'000, .azimuth_ticks = 333, .echo = 1});
    EXPECT_EQ(later.hits.size(), 1U);
    EXPECT_GT(later.cells.size(), 5U);
    for (const CellEvidence& seen : later.cells) {
      EXPECT_GE(seen.step, 0);
    }
    const auto missing = of({.range_mm = 0, .azimuth_ticks = 333});
    EXPECT_TRUE(missing.cells.empty());
  }
}

// The scan points that mark: "hits" are their cells, once each, inside the grid.
TEST(Projection, UnderTheModelEveryHitIsTheCellOfStep0) {
  const Vehicle& vehicle = tests::ThreeLux::kVehicle;
  const FrameEvidence evidence = project(vehicle, random_points(vehicle, 5, 3000));
  std::vector<std::uint32_t> marked;
  for (const CellEvidence& seen : evidence.cells) {
    if (seen.step == 0) {
      marked.push_back(seen.cell);
    }
  }
  EXPECT_GT(marked.size(), 500U);
  EXPECT_EQ(marked, evidence.hits);
}

}  // namespace
}  // namespace iog::lab
