// Properties of a unit that the car file gives because its packets do not contain them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "lidar/laser.hpp"

namespace iog::lidar {

// The mode in which an Ouster turns.
struct TurnMode {
  std::uint16_t columns_per_turn = 0;
  std::uint16_t turns_per_second = 0;

  [[nodiscard]] constexpr bool is_valid() const;
  // Time from one column to the next, rounded down. Requires a valid mode.
  [[nodiscard]] constexpr std::uint32_t column_ns() const {
    return 1'000'000'000U / (std::uint32_t{columns_per_turn} * turns_per_second);
  }
  friend constexpr bool operator==(const TurnMode&, const TurnMode&) = default;
};

// The modes that an Ouster can be set to.
inline constexpr std::array<TurnMode, 5> kTurnModes{
    {{512, 10}, {1024, 10}, {2048, 10}, {512, 20}, {1024, 20}}};

constexpr bool TurnMode::is_valid() const {
  return std::ranges::find(kTurnModes, *this) != kTurnModes.end();
}

struct Unit {
  // One correction per layer, or none. If the packets of a format do not give the number of layers,
  // it is the size of this span. The storage must be static or outlive the packets.
  std::span<const LaserCorrection> corrections{};
  // For units whose points carry their own elevations: the elevations of the layers in rising
  // order, in 3,200ths of a degree. Same lifetime.
  std::span<const std::int32_t> elevations{};
  // Set for formats whose packets do not contain these two values.
  std::uint16_t columns_per_turn = 0;
  std::uint32_t column_ns = 0;
};

}  // namespace iog::lidar
