// The temperature monitor against the i.MX6DQ manual, and the calibration of a real chip.
#include "thermometer.hpp"

#include <gtest/gtest.h>

#include "hal/thermometer.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

using hal::kTemperatureNotKnown;
using machine::poke;

class ThermometerOfTheChip : public testing::Test {
 protected:
  // An i.MX6QP's, of NXP's community: 1394 counts at 25 degrees, 1229 at 125.
  static constexpr std::uint32_t kFuses = 0x5724'cd7d;

  ThermometerOfTheChip() {
    machine::recorder.reset();
    poke(ocotp_.ana1, kFuses);
  }

  std::int16_t read(std::uint32_t count, bool is_finished = true) {
    poke(analog_.tempsense0, count << 8 | (is_finished ? 6u : 2u));
    return thermometer_.read_dc();
  }

  AnalogRegisters analog_{};
  OcotpRegisters ocotp_{};
  Thermometer thermometer_{analog_, ocotp_};
};

// A loader's alarm and its powering down are gone before the start; MISC0 keeps its other bits.
TEST_F(ThermometerOfTheChip, IsPoweredAndMeasuresEightTimesASecond) {
  poke(analog_.misc0, 0x0400'0080u);
  poke(analog_.tempsense0, 0xabc0'0001u);
  thermometer_.start();
  const std::vector<machine::Write> expected = {
      {0x150, 0x0400'0088}, {0x180, 0}, {0x190, 4096}, {0x180, 2}};
  EXPECT_EQ(machine::writes_to(analog_), expected);
}

// Between its points 100 degrees lie in 165 counts: a count is 0.606 degrees, less counts are
// hotter.
TEST_F(ThermometerOfTheChip, IsOnTheLineThroughItsTwoPoints) {
  thermometer_.start();
  EXPECT_EQ(read(1394), 250);
  EXPECT_EQ(read(1229), 1250);
  EXPECT_EQ(read(1312), 747);   // 125 - 83 * 0.60606 = 74.697
  EXPECT_EQ(read(1295), 850);   // 125 - 66 * 0.60606
  EXPECT_EQ(read(1502), -405);  // 125 - 273 * 0.60606 = -40.4545
  EXPECT_EQ(read(1196), 1450);  // beyond the hot point
}

TEST_F(ThermometerOfTheChip, KeepsItsValueWhileTheNextMeasurementRuns) {
  thermometer_.start();
  EXPECT_EQ(thermometer_.read_dc(), kTemperatureNotKnown) << "none yet, as ever in QEMU";
  EXPECT_EQ(read(1394), 250);
  for (int i = 0; i < 24; ++i) {
    EXPECT_EQ(read(0, false), 250);
  }
  EXPECT_EQ(read(0, false), kTemperatureNotKnown) << "it has stopped";
  EXPECT_EQ(read(1229), 1250);
}

TEST_F(ThermometerOfTheChip, WithoutACalibrationOrWithAnImpossibleCountIsNotKnown) {
  for (const std::uint32_t fuses : {0u, 0xffff'ffffu, 0x4cd5'727du, 0x5724'cd19u, 0x5724'cd00u}) {
    poke(ocotp_.ana1, fuses);
    thermometer_.start();
    EXPECT_EQ(read(1300), kTemperatureNotKnown) << std::hex << fuses;
  }
  poke(ocotp_.ana1, kFuses);
  thermometer_.start();
  EXPECT_EQ(read(0), kTemperatureNotKnown);
  EXPECT_EQ(read(0xfff), kTemperatureNotKnown);
}

}  // namespace
}  // namespace iog::imx6
