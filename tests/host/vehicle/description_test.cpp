// Which descriptions ask for what no target can do: they do not compile, which a concept can ask.
#include <array>
#include <cstdint>
#include <gtest/gtest.h>

#include "fakes/test_vehicles.hpp"
#include "vehicle/compile.hpp"
#include "vehicle/scanners.hpp"

namespace iog::vehicle {

namespace {

constexpr std::array<Sensor, 1> kOnPort100 = [] {
  std::array<Sensor, 1> sensors;
  sensors[0].udp_port = 100;
  return sensors;
}();

// A call that ends the compilation is no constant, and so no template argument.
template <const Description& kDescription>
concept Compiles = requires {
  typename std::array<int, (compile_vehicle(kDescription, kOnPort100).frame_period_us > 0 ? 1 : 2)>;
};

constexpr Description described(Grids grids) { return {.name = "a car", .grids = grids}; }

constexpr Description kBoth = described(Grids::kBoth);
constexpr Description kClasses = described(Grids::kClasses);

constexpr Description with_bayes(Grids grids) {
  Description description = described(grids);
  description.rule = FusionRule::kBayes;
  return description;
}
constexpr Description kIndexes = described(Grids::kIndexes);
constexpr Description kBayesIndexes = with_bayes(Grids::kIndexes);
constexpr Description kBayesClasses = with_bayes(Grids::kClasses);

constexpr Description with_nearest(Grids grids) {
  Description description = described(grids);
  description.quantisation = index::Quantisation::kNearest;
  return description;
}
constexpr Description kNearestIndexes = with_nearest(Grids::kIndexes);
constexpr Description kNearestBoth = with_nearest(Grids::kBoth);

constexpr Description with_poses(Grids grids, pose::SourceDescription poses) {
  Description description = described(grids);
  description.poses = poses;
  return description;
}
constexpr Description kSharedPort = with_poses(Grids::kBoth, {.udp_port = 100});
constexpr Description kSharedPortUnused = with_poses(Grids::kIndexes, {.udp_port = 100});
constexpr Description kLongSlices = with_poses(Grids::kBoth, {.log2_slice_ms = 7});
constexpr Description kNoPort = with_poses(Grids::kBoth, {.udp_port = 0});

constexpr Description with_map_port(Grids grids, std::uint16_t udp_port) {
  Description description = described(grids);
  description.maps.udp_port = udp_port;
  return description;
}
constexpr Description kMapsOnSensorsPort = with_map_port(Grids::kBoth, 100);
constexpr Description kMapsOnPosesPort = with_map_port(Grids::kBoth, 15'010);
constexpr Description kMapsOnNoPort = with_map_port(Grids::kBoth, 0);
constexpr Description kMapsUnused = with_map_port(Grids::kIndexes, 100);

TEST(Description, ClassesNeedHitsWinAndBlurring) {
  EXPECT_TRUE(Compiles<kBoth>);
  EXPECT_TRUE(Compiles<kClasses>);
  EXPECT_TRUE(Compiles<kBayesIndexes>);
  EXPECT_FALSE(Compiles<kBayesClasses>);
  EXPECT_TRUE(Compiles<kNearestIndexes>);
  EXPECT_FALSE(Compiles<kNearestBoth>);
}

TEST(Description, PosesNeedAPortOfTheirOwnAndShortSlices) {
  EXPECT_FALSE(Compiles<kSharedPort>);
  EXPECT_TRUE(Compiles<kSharedPortUnused>);
  EXPECT_FALSE(Compiles<kLongSlices>);
  EXPECT_FALSE(Compiles<kNoPort>);
}

TEST(Description, MapsNeedAPortOfTheirOwn) {
  EXPECT_FALSE(Compiles<kMapsOnSensorsPort>);
  EXPECT_FALSE(Compiles<kMapsOnPosesPort>);
  EXPECT_FALSE(Compiles<kMapsOnNoPort>);
  EXPECT_TRUE(Compiles<kMapsUnused>);
}

// As many azimuth steps as given; 0 are those of the description's default.
constexpr SensorConfig turning(std::uint32_t steps, double pitch_deg = 0) {
  SensorConfig config = velodyne_vlp16("roof", 0, 2368, {.z_m = 1.5, .pitch_deg = pitch_deg});
  config.azimuth_steps_per_turn = steps;
  return config;
}

template <std::uint32_t kSteps>
concept CompilesInSteps = requires {
  typename std::array<
      int, (compile_sensors(std::array{turning(kSteps)}, kIndexes)[0].udp_port > 0 ? 1 : 2)>;
};

TEST(Description, AnAzimuthStepIsAPowerOfTwoOfATurn) {
  EXPECT_TRUE(CompilesInSteps<0>);
  EXPECT_TRUE(CompilesInSteps<256>);
  EXPECT_TRUE(CompilesInSteps<16'384>);
  EXPECT_FALSE(CompilesInSteps<128>);
  EXPECT_FALSE(CompilesInSteps<3'000>);
  EXPECT_FALSE(CompilesInSteps<32'768>);
}

// 8,192 lines are kept. Of a sensor that is tilted none are.
constexpr auto kOne = compile_sensors(std::array{turning(8'192)}, kIndexes);
constexpr auto kTwo = compile_sensors(std::array{turning(4'096), turning(4'096)}, kIndexes);
constexpr auto kThree =
    compile_sensors(std::array{turning(4'096), turning(4'096), turning(256)}, kIndexes);
constexpr auto kSteps16384 = compile_sensors(std::array{turning(16'384)}, kIndexes);
constexpr auto kTilted = compile_sensors(std::array{turning(8'192), turning(8'192, 2)}, kIndexes);

template <const auto& kSensors>
concept CompilesWith = requires {
  typename std::array<int, (compile_vehicle(kIndexes, kSensors).frame_period_us > 0 ? 1 : 2)>;
};

TEST(Description, SensorsThatTurnHaveAsManyLinesAsAreKept) {
  EXPECT_TRUE(CompilesWith<kOne>);
  EXPECT_TRUE(CompilesWith<kTwo>);
  EXPECT_TRUE(CompilesWith<kTilted>);
  EXPECT_FALSE(CompilesWith<kThree>);
  EXPECT_FALSE(CompilesWith<kSteps16384>);
}

// What the target is told of classes is what the description says.
TEST(Description, ItsRulesReachTheTarget) {
  static constexpr Description kLiteral = [] {
    Description description = described(Grids::kClasses);
    description.poses = {.source_ipv4 = 7, .udp_port = 9, .log2_slice_ms = 2};
    description.window.moved = window::Moved::kLiteral;
    description.window.assignment = &evidence::kReinforced;
    return description;
  }();
  constexpr Vehicle kVehicle = compile_vehicle(kLiteral, kOnPort100);
  EXPECT_EQ(kVehicle.grids, Grids::kClasses);
  EXPECT_EQ(kVehicle.poses.source_ipv4, 7U);
  EXPECT_EQ(kVehicle.poses.udp_port, 9);
  EXPECT_EQ(kVehicle.poses.log2_slice_ms, 2);
  EXPECT_EQ(kVehicle.window.moved, window::Moved::kLiteral);
  EXPECT_EQ(kVehicle.window.assignment, &evidence::kReinforced);
}

}  // namespace
}  // namespace iog::vehicle
