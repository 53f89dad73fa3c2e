// How warm the target's chip is, in words, and from where on that is a warning.
//
// An i.MX6Q may be as warm as its fuses' grade says: commercial ones 95 degrees at the junction,
// the least of the grades (NXP's data sheets IMX6DQCEC, IMX6DQIEC and IMX6DQAEC). Linux warns ten
// degrees below; that also covers a thermometer that is off by a few.
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
