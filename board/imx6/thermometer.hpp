// Reads the chip's temperature from its temperature monitor and the calibration in its fuses. Never
// blocks.
//
// In QEMU, the temperature is not known: QEMU only stores writes to the monitor, never finishes a
// measurement and has blank fuses.
#pragma once

#include <cstdint>

#include "registers/analog.hpp"
#include "registers/ocotp.hpp"

namespace iog::imx6 {

class Thermometer {
 public:
  Thermometer(AnalogRegisters& analog, const OcotpRegisters& ocotp)
      : analog_(analog), ocotp_(ocotp) {}

  // Starts periodic measurements. Requires start_clocks(), PLL3 and the 32 kHz clock.
  void start();

  // The last measurement in tenths of a degree Celsius. Returns hal::kTemperatureNotKnown if there
  // is no calibration, no measurement yet, or no new measurement within a second of frames.
  std::int16_t read_dc();

 private:
  AnalogRegisters& analog_;
  const OcotpRegisters& ocotp_;
  std::uint32_t calibration_ = 0;
  std::int16_t last_dc_ = 0;
  unsigned missed_ = kMostMissed;  // reads since the last measurement

  // One second of 40 ms frames, which contains eight measurements.
  static constexpr unsigned kMostMissed = 25;
};

}  // namespace iog::imx6
