// The target chip's temperature in words, and the limits for a warning.
//
// The limit of an i.MX6Q depends on its grade: 95 degrees at the junction for commercial ones, the
// lowest (NXP's data sheets IMX6DQCEC, IMX6DQIEC and IMX6DQAEC). Linux warns ten degrees below;
// that also covers a thermometer that is off by a few.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

#include "hal/thermometer.hpp"

namespace iog::tools {

inline constexpr std::int16_t kWarmDc = 850;
inline constexpr std::int16_t kTooHotDc = 950;

// "61.2 degrees Celsius".
[[nodiscard]] inline std::string words_of_temperature(std::int16_t dc) {
  return (dc < 0 ? "-" : "") + std::to_string(std::abs(dc) / 10) + "." +
         std::to_string(std::abs(dc) % 10) + " degrees Celsius";
}

}  // namespace iog::tools
