// Reads the chip's temperature from the temperature monitor and the calibration in the fuses. The
// thermometer never blocks.
//
// In QEMU, the temperature is not known, because QEMU only stores writes to the monitor, never
// finishes a measurement, and has blank fuses.
#pragma once

#include <cstdint>

#include "registers/analog.hpp"
#include "registers/ocotp.hpp"

namespace iog::imx6 {

class Thermometer {
 public:
  Thermometer(AnalogRegisters& analog, const OcotpRegisters& ocotp)
      : analog_(analog), ocotp_(ocotp) {}

  // Starts periodic measurements, which require start_clocks(), PLL3 and the 32 kHz clock.
  void start();

  // Returns the last measurement in tenths of a degree Celsius. Returns hal::kTemperatureNotKnown
  // if the fuses contain no calibration, if no measurement has finished yet, or if no new
  // measurement has finished within a second of frames.
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
