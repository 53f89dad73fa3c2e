// Hardware interface for the chip's thermometer.
#pragma once

#include <concepts>
#include <cstdint>

namespace iog::hal {

inline constexpr std::int16_t kTemperatureNotKnown = -0x8000;

// `temperature_dc()` returns the chip temperature in tenths of a degree Celsius. `temperature_dc()`
// returns kTemperatureNotKnown if the machine has no thermometer, or if the thermometer is not
// calibrated or does not respond. The call never blocks. Call this function once per frame.
template <typename T>
concept Thermometer = requires(T& machine) {
  { machine.temperature_dc() } -> std::same_as<std::int16_t>;
};

}  // namespace iog::hal
