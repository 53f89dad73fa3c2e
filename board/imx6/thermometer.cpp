// TEMPMON by IMX6DQRM, chapter "Temperature Monitor (TEMPMON)", "Software Usage Guidelines".
#include "thermometer.hpp"

#include "hal/thermometer.hpp"

namespace iog::imx6 {
namespace {

using R = AnalogRegisters;

// Clocks of 32.768 kHz between two measurements: 1/8 s.
constexpr std::uint32_t kMeasureFrequency = 4096;

constexpr std::int32_t kRoomDc = 250;
// The limits of a working chip: beyond them the fuses are wrong or the count is invalid.
constexpr std::int32_t kLeastDc = -600;
constexpr std::int32_t kMostDc = 2000;

// OCOTP_ANA1: ROOM_COUNT in bits 31:20, HOT_COUNT in 19:8, HOT_TEMP in 7:0, and
//   Tmeas = HOT_TEMP - (Nmeas - HOT_COUNT) * ((HOT_TEMP - 25.0) / (ROOM_COUNT - HOT_COUNT)).
// In tenths of a degree, rounded to the nearest. Counts are below 2^12 and the span of temperatures
// below 2^12, so the product is below 2^24.
std::int16_t temperature_dc(std::uint32_t calibration, std::uint32_t count) {
  const auto room_count = static_cast<std::int32_t>(calibration >> 20);
  const auto hot_count = static_cast<std::int32_t>(calibration >> 8 & 0xfff);
  const auto hot_dc = static_cast<std::int32_t>(calibration & 0xff) * 10;
  const std::int32_t counts = room_count - hot_count;
  if (counts <= 0 || hot_dc <= kRoomDc) {
    return hal::kTemperatureNotKnown;  // blank fuses
  }
  const std::int32_t product = (static_cast<std::int32_t>(count) - hot_count) * (hot_dc - kRoomDc);
  const std::int32_t half = product < 0 ? -counts / 2 : counts / 2;
  const std::int32_t dc = hot_dc - (product + half) / counts;
  return dc < kLeastDc || dc > kMostDc ? hal::kTemperatureNotKnown : static_cast<std::int16_t>(dc);
}

}  // namespace

void Thermometer::start() {
  calibration_ = ocotp_.ana1.read();
  // The bandgap's start-up circuit disturbs measurements by the bandgap, and is no longer needed
  // (chapter "Power Management Unit (PMU)", MISC0).
  analog_.misc0.set_bits(R::kMisc0SelfBiasOff);
  // First stop it, power it and clear the alarm, whatever the loader has left; then set the rate;
  // then start.
  analog_.tempsense0.write(0);
  analog_.tempsense1.write(kMeasureFrequency);
  analog_.tempsense0.write(R::kTempsense0Measure);
}

std::int16_t Thermometer::read_dc() {
  // FINISHED is 0 while the next measurement runs.
  const std::uint32_t now = analog_.tempsense0.read();
  if ((now & R::kTempsense0Finished) != 0) {
    last_dc_ =
        temperature_dc(calibration_, now >> R::kTempsense0CountShift & R::kTempsense0CountMask);
    missed_ = 0;
  } else if (missed_ < kMostMissed) {
    ++missed_;
  }
  return missed_ < kMostMissed ? last_dc_ : hal::kTemperatureNotKnown;
}

}  // namespace iog::imx6
