// The baseline is the one that it is named after: the sequential sum over every crossed cell,
// sampled at its centre, as lab/evidence has it in exact integers, cell for cell.
//
// The baseline rounds where a centre projects to, to 2^-20 of a 1D cell; a centre so near to the
// end of a 1D cell does not occur below.
#include "lab/baseline/printed_fusion.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "lab/evidence/fusion_rules.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/evidence/values.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;

constexpr std::int32_t kInt8Limit = 127;

std::vector<std::int32_t> grid_of(const vehicle::Vehicle& vehicle, const FramePoints& points,
                                  Extent extent) {
  const auto fusion = std::make_unique<PrintedFusion>(vehicle, extent);
  for (const SensorPoint& seen : points) {
    fusion->add(vehicle.sensors[seen.sensor], seen.point);
  }
  return {fusion->cells().begin(), fusion->cells().end()};
}

std::vector<std::int32_t> sequential_sum(const vehicle::Vehicle& vehicle, const FramePoints& points,
                                         Quantisation policy) {
  const FrameEvidence evidence = project(vehicle, points, Sampling::kCentre);
  return fuse_indexes(evidence, indexes(probabilities({}), 0.05, policy), IndexRule::kSequential,
                      kInt8Limit);
}

void expect_the_sequential_sum(const vehicle::Vehicle& vehicle, const FramePoints& points,
                               Quantisation policy) {
  const std::vector<std::int32_t> expected = sequential_sum(vehicle, points, policy);
  EXPECT_EQ(grid_of(vehicle, points, Extent::kToScanPoint), expected);
  EXPECT_EQ(grid_of(vehicle, points, Extent::kWholeBeam), expected);
}

// Every fate, flag and echo, every direction; a quarter of them along an axis or a diagonal.
FramePoints random_points(std::uint64_t seed, int count) {
  tests::Random random(seed);
  FramePoints points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        {0,
         {.range_mm = random.one_in(20) ? 0 : static_cast<std::uint32_t>(random.between(1, 60'000)),
          .azimuth_ticks = static_cast<std::uint16_t>(random.one_in(4) ? random.between(0, 7) * 1440
                                                                       : random.between(0, 11519)),
          .layer = static_cast<std::uint8_t>(random.between(0, 3)),
          .echo = static_cast<std::uint8_t>(random.one_in(8) ? 1 : 0),
          .is_ground = random.one_in(16),
          .is_dirt = random.one_in(16)}});
  }
  return points;
}

TEST(PrintedFusion, IsTheSequentialSumOnSimulatedFrames) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  for (const char* const scene : {"city", "ring_road"}) {
    tools::Drive drive(car, 1, 2, tools::find_scene(scene));
    for (const std::uint32_t frame : {0U, 23U}) {
      expect_the_sequential_sum(*car.vehicle, points_of(drive, frame, car),
                                Quantisation::kBlurring);
    }
  }
}

TEST(PrintedFusion, IsTheSequentialSumForBeamsOfEveryKind) {
  expect_the_sequential_sum(tests::OneLux::kVehicle, random_points(1, 400),
                            Quantisation::kBlurring);
  expect_the_sequential_sum(tests::MidCellLux::kVehicle, random_points(2, 400),
                            Quantisation::kBlurring);
  expect_the_sequential_sum(tests::TiltedLux::kVehicle, random_points(3, 400),
                            Quantisation::kBlurring);
  expect_the_sequential_sum(tests::OneLuxNearest::kVehicle, random_points(4, 400),
                            Quantisation::kNearest);
}

TEST(PrintedFusion, ClearedItStartsFromUnknown) {
  const FramePoints points = random_points(5, 100);
  const auto fusion = std::make_unique<PrintedFusion>(tests::OneLux::kVehicle);
  for (int round = 0; round < 2; ++round) {
    for (const SensorPoint& seen : points) {
      fusion->add(tests::OneLux::kVehicle.sensors[0], seen.point);
    }
    const std::vector<std::int32_t> cells(fusion->cells().begin(), fusion->cells().end());
    EXPECT_EQ(cells, sequential_sum(tests::OneLux::kVehicle, points, Quantisation::kBlurring));
    fusion->clear();
  }
}

}  // namespace
}  // namespace iog::lab
