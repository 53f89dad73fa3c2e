// Scans of LUX that no capture is needed for: a fan of directions, each with four layers that meet
// something at about one range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tools/formats/lux/lux_message.hpp"

namespace iog::lab {

struct Fan {
  std::uint32_t azimuths = 0;  // directions, from +50 to -50 degrees; see kMostAzimuths
  std::uint32_t range_cm = 0;  // ranges are drawn from the last tenth below
};

inline constexpr std::uint32_t kMostAzimuths = 801;  // an eighth of a degree, the LUX's finest

// One message of a scan, below every usual MTU.
class SyntheticScan {
 public:
  // The messages of a scan; azimuths - 1 divides 3200 ticks.
  [[nodiscard]] static std::uint32_t messages(const Fan& fan);

  // That message of that scan, valid until the next call. The same numbers, the same bytes.
  [[nodiscard]] std::span<const std::byte> write(const Fan& fan, std::uint32_t sensor,
                                                 std::uint32_t scan, std::uint32_t message);

 private:
  std::array<std::byte, tools::kMaxLuxDatagramBytes> bytes_{};
};

}  // namespace iog::lab
