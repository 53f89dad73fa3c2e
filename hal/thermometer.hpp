// Hardware interface for the chip's thermometer.
#pragma once

#include <concepts>
#include <cstdint>

namespace iog::hal {

inline constexpr std::int16_t kTemperatureNotKnown = -0x8000;

// temperature_dc():  chip temperature in tenths of a degree Celsius. kTemperatureNotKnown if there
//                    is no thermometer, it has no calibration, or it does not answer. Never waits.
//                    Call it once a frame.
template <typename T>
concept Thermometer = requires(T& machine) {
  { machine.temperature_dc() } -> std::same_as<std::int16_t>;
};

}  // namespace iog::hal
