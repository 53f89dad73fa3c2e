// The name of a vehicle in a stream: the CRC-32 of bytes that are listed here as docs/spec.md,
// section 8.4, says.
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "car_block/content.hpp"
#include "fakes/bitwise_crc32.hpp"

namespace iog::car_block {
namespace {

using vehicle::Grids;
using vehicle::Sensor;
using vehicle::Vehicle;

std::uint32_t crc_of(const std::vector<std::uint8_t>& bytes) {
  return tests::BitwiseCrc32().add(std::as_bytes(std::span(bytes))).value();
}

struct Bytes {
  std::vector<std::uint8_t> all;
  Bytes& text(const std::string& value) {
    all.insert(all.end(), value.begin(), value.end());
    all.push_back(0);
    return *this;
  }
  Bytes& number(int bytes, std::int64_t value) {
    for (int byte = bytes; byte-- > 0;) {
      all.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
    }
    return *this;
  }
};

Vehicle car() {
  Vehicle car;
  car.name = "car";
  car.footprint = {.x_min = -1, .x_max = 2, .y_min = -3, .y_max = 4};
  car.z_min = 5;
  car.z_max = 6;
  car.rule = vehicle::FusionRule::kBayes;
  car.frame_period_us = 40'000;
  car.grids = Grids::kBoth;
  car.has_objects = true;
  car.poses = {.source_ipv4 = 7, .udp_port = 8, .log2_slice_ms = 3};
  car.maps = {.source_ipv4 = 9, .udp_port = 10};
  car.window.group_budget = 11;
  return car;
}

Bytes bytes_of_car() {
  Bytes bytes;
  bytes.number(2, geometry::kCellMm).number(2, geometry::kCellsPerSide);
  bytes.number(2, geometry::kResolution);
  bytes.text("car").number(4, -1).number(4, 2).number(4, -3).number(4, 4).number(4, 5).number(4, 6);
  bytes.number(1, 1).number(1, 0).number(4, 40'000).number(1, 2);
  bytes.number(4, 7).number(2, 8).number(1, 3).number(4, 9).number(2, 10);
  return bytes.number(1, 0).number(1, 0).number(1, 0).number(4, 11).number(1, 0);
}

TEST(Identity, IsTheCrcOfTheMembersInTheirOrder) {
  EXPECT_EQ(identity_of(car()), crc_of(bytes_of_car().number(1, 0).all));
}

// A grid that is no square around the car: 0 cells of a side, and four numbers more.
TEST(Identity, HasTheRectangleOfTheGrid) {
  Vehicle with = car();
  with.grid = {.cell_mm = 200, .columns = 512, .rows = 320, .origin_column = 0, .origin_row = 160};
  Bytes grid;
  grid.number(2, 200).number(2, 0).number(2, geometry::kResolution);
  grid.number(2, 512).number(2, 320).number(2, 0).number(2, 160);
  const auto rest = bytes_of_car().number(1, 0).all;
  grid.all.insert(grid.all.end(), rest.begin() + 6, rest.end());
  EXPECT_EQ(identity_of(with), crc_of(grid.all));
}

// A window of fewer tiles than the memory has: 4 more in the byte of `moved`, and two numbers.
TEST(Identity, HasTheRectangleOfTheWindow) {
  Vehicle with = car();
  with.window.extent = {.columns = 12, .rows = 32};
  const auto whole = bytes_of_car().number(1, 0).all;
  const auto moved = whole.end() - 7;  // then the budget, no assignment and no sensors
  Bytes bytes;
  bytes.all.assign(whole.begin(), moved);
  bytes.number(1, 4).number(1, 12).number(1, 32);
  bytes.all.insert(bytes.all.end(), moved + 1, whole.end());
  EXPECT_EQ(identity_of(with), crc_of(bytes.all));
}

TEST(Identity, HasTheSensorsToo) {
  std::array<Sensor, 1> sensors;
  Sensor& sensor = sensors[0];
  sensor.name = "s";
  sensor.udp_port = 100;
  sensor.origin = {-20, 21};
  sensor.layer_count = 1;
  sensor.layers[0].z = {.base = -22, .forward = 23, .left = 24};
  sensor.is_calibrated = true;
  sensor.laser_corrections[0] = {.azimuth_ticks = -25, .range_mm = 26};
  Vehicle with = car();
  with.sensors = sensors;
  Bytes bytes = bytes_of_car();
  bytes.number(1, 1).text("s").text("ibeo LUX").number(4, 0).number(2, 100);
  bytes.number(4, -20).number(4, 21).number(4, 0).number(1, 0);
  bytes.number(4, 1).number(4, 1);
  bytes.number(4, sensor.range.mm()).number(4, 0).number(4, 1);
  bytes.number(4, 0).number(2, 0).number(4, 0).number(1, 0).number(4, 0).number(1, 1);
  bytes.number(8, 0).number(4, 0).number(4, 0).number(8, 0).number(4, 0).number(4, 0);
  bytes.number(8, -22).number(4, 23).number(4, 24).number(1, 0).number(4, 1 << 30);
  bytes.number(1, 1).number(2, -25).number(2, 26).number(2, 0).number(4, 0);
  bytes.number(4, 0).number(8, 0).number(8, 0);  // an empty profile of 8 near cells on each side
  EXPECT_EQ(identity_of(with), crc_of(bytes.all));
}

// Of a car that follows things where it can, and of one that has no classes, it is as it was before
// any could.
TEST(Identity, HasThatNothingIsFollowed) {
  const auto byte_with = [](Grids grids, bool has_objects) {
    std::vector<std::uint8_t> bytes;
    content_detail::Writer out([&](std::uint8_t byte) { bytes.push_back(byte); });
    out.grids_and_objects(grids, has_objects);
    return bytes;
  };
  EXPECT_EQ(byte_with(Grids::kIndexes, false), (std::vector<std::uint8_t>{0}));
  EXPECT_EQ(byte_with(Grids::kClasses, true), (std::vector<std::uint8_t>{1}));
  EXPECT_EQ(byte_with(Grids::kClasses, false), (std::vector<std::uint8_t>{5}));
  EXPECT_EQ(byte_with(Grids::kBoth, true), (std::vector<std::uint8_t>{2}));
  EXPECT_EQ(byte_with(Grids::kBoth, false), (std::vector<std::uint8_t>{6}));
}

// The bytes of a car with the usual epsilon are what they were before epsilon was among them.
TEST(Identity, HasAnUnusualEpsilon) {
  const auto bytes_with = [](std::uint16_t epsilon_e5) {
    std::vector<std::uint8_t> bytes;
    content_detail::Writer out([&](std::uint8_t byte) { bytes.push_back(byte); });
    out.quantisation_and_epsilon(index::Quantisation::kNearest, epsilon_e5);
    return bytes;
  };
  EXPECT_EQ(bytes_with(5'000), (std::vector<std::uint8_t>{1}));
  EXPECT_EQ(bytes_with(0x1234), (std::vector<std::uint8_t>{3, 0x12, 0x34}));
}

// Of one that has neither, the bytes are what they were before any could.
TEST(Identity, HasTheGroundAndWhatOpensItOfASensorThatHasThem) {
  using vehicle::GroundLimits;
  using vehicle::MovedLimits;
  const auto bytes_with = [](bool shares, GroundLimits ground, MovedLimits moved) {
    std::vector<std::uint8_t> bytes;
    content_detail::Writer out([&](std::uint8_t byte) { bytes.push_back(byte); });
    out.shares_and_heights(shares, ground, moved);
    return bytes;
  };
  EXPECT_EQ(bytes_with(false, {}, {}), (std::vector<std::uint8_t>{0}));
  EXPECT_EQ(bytes_with(true, {}, {}), (std::vector<std::uint8_t>{1}));
  EXPECT_EQ(bytes_with(true, {0x0102, 0x0304}, {}), (std::vector<std::uint8_t>{3, 1, 2, 3, 4}));
  EXPECT_EQ(bytes_with(false, {0x0102, 0x0304}, {}), (std::vector<std::uint8_t>{2, 1, 2, 3, 4}));
  EXPECT_EQ(bytes_with(true, {}, {0x0102, 0x0304}), (std::vector<std::uint8_t>{5, 1, 2, 3, 4}));
  EXPECT_EQ(bytes_with(true, {1, 2}, {3, 4}),
            (std::vector<std::uint8_t>{7, 0, 1, 0, 2, 0, 3, 0, 4}));
}

}  // namespace
}  // namespace iog::car_block
