// What a unit's packets do not say of it, and its description does.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "lidar/laser.hpp"

namespace iog::lidar {

// How an Ouster turns.
struct TurnMode {
  std::uint16_t columns_per_turn = 0;
  std::uint16_t turns_per_second = 0;

  [[nodiscard]] constexpr bool is_valid() const;
  // From one column to the next, rounded down. Only if it is valid.
  [[nodiscard]] constexpr std::uint32_t column_ns() const {
    return 1'000'000'000U / (std::uint32_t{columns_per_turn} * turns_per_second);
  }
  friend constexpr bool operator==(const TurnMode&, const TurnMode&) = default;
};

// What it can be set to.
inline constexpr std::array<TurnMode, 5> kTurnModes{
    {{512, 10}, {1024, 10}, {2048, 10}, {512, 20}, {1024, 20}}};

constexpr bool TurnMode::is_valid() const {
  return std::ranges::find(kTurnModes, *this) != kTurnModes.end();
}

struct Unit {
  // One for each layer, or none. A format whose packets do not say how many layers there are takes
  // their number from here. It is of static storage, or outlives the packets.
  std::span<const LaserCorrection> corrections{};
  // Of a unit whose points say their own elevations: those of its layers, each above the one
  // before, in 3,200ths of a degree. Of the same storage.
  std::span<const std::int32_t> elevations{};
  // Of a format whose packets do not say it.
  std::uint16_t columns_per_turn = 0;
  std::uint32_t column_ns = 0;
};

}  // namespace iog::lidar
