// What eight layers add to a LUX's messages, against SICK's own driver (libsick_ldmrs, LuxBase.cpp:
// "bit 10: mirror side: 0 = front (for 8-layer, tilted downward), 1 = rear").
#include "lidar/ibeo_lux8.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/lux_message.hpp"

namespace iog::lidar {
namespace {

using tests::LuxMessage;

std::vector<int> layers_of(const LuxMessage& message) {
  IbeoLux8 lux;
  const std::vector<std::byte> bytes = message.bytes();
  EXPECT_EQ(lux.decode(bytes), DecodeStatus::kOk);
  std::vector<int> layers;
  lux.for_each_point([&](const ScanPoint& point) { layers.push_back(point.layer); });
  return layers;
}

DecodeStatus decode(const LuxMessage& message) {
  IbeoLux8 lux;
  const std::vector<std::byte> bytes = message.bytes();
  return lux.decode(bytes);
}

TEST(IbeoLux8, TheFlagSaysWhichFourLayers) {
  const std::vector<tests::LuxPoint> points{{.layer = 0}, {.layer = 3}, {.layer = 1}, {.layer = 2}};
  // The two values that real units send in turns, and all other bits.
  EXPECT_EQ(layers_of({.points = points, .flags = 0x002}), (std::vector{0, 3, 1, 2}));
  EXPECT_EQ(layers_of({.points = points, .flags = 0x402}), (std::vector{4, 7, 5, 6}));
  EXPECT_EQ(layers_of({.points = points, .flags = 0xFBFF}), (std::vector{0, 3, 1, 2}));
  EXPECT_EQ(layers_of({.points = points, .flags = 0xFFFF}), (std::vector{4, 7, 5, 6}));
}

// One decoder that is used again keeps nothing of the message before.
TEST(IbeoLux8, TheSideIsThatOfItsOwnMessage) {
  IbeoLux8 lux;
  const auto rear = LuxMessage{.points = {{.layer = 3}}, .flags = 0x400}.bytes();
  const auto front = LuxMessage{.points = {{.layer = 3}}, .flags = 0}.bytes();
  ASSERT_EQ(lux.decode(rear), DecodeStatus::kOk);
  ASSERT_EQ(lux.decode(front), DecodeStatus::kOk);
  lux.for_each_point([](const ScanPoint& point) { EXPECT_EQ(point.layer, 3); });
}

// All but the layer is read as of a LUX with four.
TEST(IbeoLux8, IsALuxOtherwise) {
  const auto bytes =
      LuxMessage{
          .scan_number = 77,
          .points = {{.layer = 2, .echo = 1, .flags = 4, .angle_ticks = -32, .range_cm = 1234}},
          .flags = 0x403}
          .bytes();
  IbeoLux four;
  IbeoLux8 eight;
  ASSERT_EQ(four.decode(bytes), DecodeStatus::kOk);
  ASSERT_EQ(eight.decode(bytes), DecodeStatus::kOk);
  EXPECT_EQ(eight.info().scan_number, 77U);
  EXPECT_EQ(eight.info().fingerprint, four.info().fingerprint);
  EXPECT_EQ(eight.info().sector.first_ticks, four.info().sector.first_ticks);
  EXPECT_EQ(eight.info().sector.width_ticks, four.info().sector.width_ticks);
  eight.for_each_point([](const ScanPoint& point) {
    EXPECT_EQ(point.range_mm, 12'340U);
    EXPECT_EQ(point.azimuth_ticks, 11520 - 32);
    EXPECT_EQ(point.layer, 6);
    EXPECT_EQ(point.echo, 1);
    EXPECT_TRUE(point.is_ground);
  });
}

// Ranges alone, as they stand in the message: 2 bytes, cm.
TEST(IbeoLux8, RangesAreThoseOfItsPoints) {
  const auto bytes =
      LuxMessage{.points = {{.layer = 2, .range_cm = 1234}, {.range_cm = 0}, {.range_cm = 65535}},
                 .flags = 0x402}
          .bytes();
  IbeoLux8 lux;
  ASSERT_EQ(lux.decode(bytes), DecodeStatus::kOk);
  std::vector<std::uint32_t> ranges_cm;
  static_cast<void>(lux.for_each_range([&](std::uint32_t range) { ranges_cm.push_back(range); }));
  EXPECT_EQ(ranges_cm, (std::vector<std::uint32_t>{1234, 0, 65535}));
}

// The two halves of a picture differ in their numbers and in their flag.
TEST(IbeoLux8, HalvesAreNoDuplicates) {
  IbeoLux8 front;
  IbeoLux8 rear;
  ASSERT_EQ(front.decode(LuxMessage{.flags = 0x002}.bytes()), DecodeStatus::kOk);
  ASSERT_EQ(rear.decode(LuxMessage{.flags = 0x402}.bytes()), DecodeStatus::kOk);
  EXPECT_NE(front.info().fingerprint, rear.info().fingerprint);
}

// Status 0x8000: it hangs upside down, and the sides of its mirror change places.
TEST(IbeoLux8, RefusesAUnitThatHangsUpsideDown) {
  EXPECT_EQ(decode({.points = {{}}, .status = 0x830B}), DecodeStatus::kOtherUnit);
  EXPECT_EQ(decode({.points = {{}}, .status = 0x7FFF}), DecodeStatus::kOk);
}

// +50 degrees to -60, by the limits that SICK's driver sets (1600 and -1920 ticks).
TEST(IbeoLux8, RefusesWhatItCannotSee) {
  EXPECT_EQ(decode({.start_ticks = 1600, .end_ticks = -1920}), DecodeStatus::kOk);
  EXPECT_EQ(decode({.start_ticks = -1920, .end_ticks = 1600}), DecodeStatus::kOk);
  EXPECT_EQ(decode({.start_ticks = 1601, .end_ticks = 0}), DecodeStatus::kWrongAngle);
  EXPECT_EQ(decode({.start_ticks = 0, .end_ticks = -1921}), DecodeStatus::kWrongAngle);
  EXPECT_EQ(decode({.start_ticks = 5760, .end_ticks = 5760}), DecodeStatus::kWrongAngle);
  EXPECT_EQ(decode({.start_ticks = -5760, .end_ticks = -5760}), DecodeStatus::kWrongAngle);
}

TEST(IbeoLux8, RefusesImpossiblePoints) {
  EXPECT_EQ(decode({.points = {{.layer = 4}}, .flags = 0x400}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(decode({.points = {{.layer = 7}}}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(decode({.points = {{.echo = 3}}}), DecodeStatus::kWrongPoint);
}

}  // namespace
}  // namespace iog::lidar
