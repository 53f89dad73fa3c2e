// How warm the chip is, by its temperature monitor and the calibration in its fuses. Never waits.
//
// QEMU keeps what is written to the monitor and never finishes a measurement, and its fuses are
// blank: there the temperature is not known.
#pragma once

#include <cstdint>

#include "registers/analog.hpp"
#include "registers/ocotp.hpp"

namespace iog::imx6 {

class Thermometer {
 public:
  Thermometer(AnalogRegisters& analog, const OcotpRegisters& ocotp)
      : analog_(analog), ocotp_(ocotp) {}

  // Starts to measure, again and again. Needs the clocks of start_clocks(), PLL3 and the 32 kHz.
  void start();

  // The last measurement in tenths of a degree Celsius; hal::kTemperatureNotKnown before the first
  // one, after a second of frames without another, and without a calibration.
  std::int16_t read_dc();

 private:
  AnalogRegisters& analog_;
  const OcotpRegisters& ocotp_;
  std::uint32_t calibration_ = 0;
  std::int16_t last_dc_ = 0;
  unsigned missed_ = kMostMissed;  // reads since a measurement was there

  // A second of frames of 40 ms; there are eight measurements in it.
  static constexpr unsigned kMostMissed = 25;
};

}  // namespace iog::imx6
