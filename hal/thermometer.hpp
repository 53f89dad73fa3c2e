// Hardware interface for the chip's thermometer.
#pragma once

#include <concepts>
#include <cstdint>

namespace iog::hal {

inline constexpr std::int16_t kTemperatureNotKnown = -0x8000;

// temperature_dc():  chip temperature in tenths of a degree Celsius, or kTemperatureNotKnown if
//                    there is no thermometer, it is not calibrated, or it does not respond. The
//                    call never blocks. Call it once per frame.
template <typename T>
concept Thermometer = requires(T& machine) {
  { machine.temperature_dc() } -> std::same_as<std::int16_t>;
};

}  // namespace iog::hal
