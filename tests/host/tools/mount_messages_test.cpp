// A mount's quaternion turns a sensor's axes to where description::rotation_of has them: two ways
// to the same turn.
#include "tools/formats/ros/mount_messages.hpp"

#include <array>
#include <bit>

#include "gtest/gtest.h"

#include "tools/car/mount.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools::ros {
namespace {

double f64(wire::ByteReader& in) {
  const std::uint64_t low = in.u32_le();
  return std::bit_cast<double>(std::uint64_t{in.u32_le()} << 32 | low);
}

// Of the turn by (x, y, z, w), what it makes of the axes.
std::array<std::array<double, 3>, 3> axes_of(double x, double y, double z, double w) {
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
           {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
           {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}}};
}

// One transform of a sensor without a name: sequence, stamp, "base_link" and its zero, an empty
// text, each aligned; then three numbers of its place and four of its turn.
TEST(Mounts, AreTurnedAsTheDescriptionTurnsThem) {
  description::SensorConfig sensor{};
  sensor.name = "";
  sensor.mount = {
      .x_m = 1.5, .y_m = -0.5, .z_m = 1.25, .yaw_deg = 40, .pitch_deg = 15, .roll_deg = -25};
  const std::vector<std::byte> message = mounts_of({&sensor, 1}, 7'000'002);
  wire::ByteReader in(message);
  EXPECT_EQ(in.u32_be(), 0x00010000U);
  EXPECT_EQ(in.u32_le(), 1U);
  EXPECT_EQ(in.u32_le(), 7U);
  EXPECT_EQ(in.u32_le(), 2'000U);
  EXPECT_EQ(in.u32_le(), 10U) << "base_link and its zero";
  in.skip(12);
  EXPECT_EQ(in.u32_le(), 1U) << "the zero of no name";
  in.skip(8);
  EXPECT_EQ(f64(in), 1.5);
  EXPECT_EQ(f64(in), -0.5);
  EXPECT_EQ(f64(in), 1.25);
  const double x = f64(in);
  const double y = f64(in);
  const double z = f64(in);
  const double w = f64(in);
  ASSERT_TRUE(in.ok());
  EXPECT_EQ(in.remaining(), 0U);
  const auto axes = axes_of(x, y, z, w);
  const description::Rotation wanted = description::rotation_of(sensor.mount);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(axes[0][i], wanted.forward[i], 1e-9) << i;
    EXPECT_NEAR(axes[1][i], wanted.left[i], 1e-9) << i;
    EXPECT_NEAR(axes[2][i], wanted.up[i], 1e-9) << i;
  }
}

}  // namespace
}  // namespace iog::tools::ros
