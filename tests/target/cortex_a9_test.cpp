// Is the test image really on the processor that the project is for?
#include <arm_neon.h>
#include <bit>
#include <cstdint>

#include "gtest/gtest.h"

namespace {

// Cortex-A9 Technical Reference Manual (DDI 0388), 4.3.1: implementer Arm, architecture by CPUID,
// part 0xC09. Variant and revision are left out: the i.MX6Q has r2p10, QEMU says r0p0.
TEST(CortexA9, IsTheProcessor) {
  std::uint32_t midr = 0;
  asm("mrc p15, 0, %0, c0, c0, 0" : "=r"(midr));
  EXPECT_EQ(midr & 0xff0f'fff0U, 0x410f'c090U);
}

TEST(CortexA9, IsLittleEndianWith32BitPointers) {
  EXPECT_EQ(std::endian::native, std::endian::little);
  EXPECT_EQ(sizeof(void*), 4U);
}

// Arm's plain char is unsigned, and a shift of a negative number keeps its sign; index arithmetic
// must name its types for that reason.
TEST(CortexA9, KeepsTheSignOfInt8) {
  volatile std::int8_t index = -127;
  EXPECT_EQ(index >> 1, -64);
  EXPECT_EQ(static_cast<std::int8_t>(index - 2), 127);
  EXPECT_LT(static_cast<char>(0), static_cast<char>(-1));
}

TEST(CortexA9, SaturatesSixteenIndexesWithNeon) {
  const int8x16_t sum = vqaddq_s8(vdupq_n_s8(-100), vdupq_n_s8(-100));
  EXPECT_EQ(vgetq_lane_s8(sum, 0), -128);
  EXPECT_EQ(vgetq_lane_s8(sum, 15), -128);
}

}  // namespace
