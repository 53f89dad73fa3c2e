// The chip's temperature, from its temperature monitor and the calibration in its fuses. Never
// waits.
//
// QEMU only stores writes to the monitor, never finishes a measurement and has blank fuses, so
// there the temperature is not known.
#pragma once

#include <cstdint>

#include "registers/analog.hpp"
#include "registers/ocotp.hpp"

namespace iog::imx6 {

class Thermometer {
 public:
  Thermometer(AnalogRegisters& analog, const OcotpRegisters& ocotp)
      : analog_(analog), ocotp_(ocotp) {}

  // Starts periodic measurements. Needs the clocks of start_clocks(), PLL3 and the 32 kHz.
  void start();

  // The last measurement in tenths of a degree Celsius; hal::kTemperatureNotKnown before the first
  // one, after a second of frames without a new one, or without a calibration.
  std::int16_t read_dc();

 private:
  AnalogRegisters& analog_;
  const OcotpRegisters& ocotp_;
  std::uint32_t calibration_ = 0;
  std::int16_t last_dc_ = 0;
  unsigned missed_ = kMostMissed;  // reads since the last measurement

  // A second of frames of 40 ms; there are eight measurements in it.
  static constexpr unsigned kMostMissed = 25;
};

}  // namespace iog::imx6
