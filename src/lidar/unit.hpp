// Properties of a unit that are given in the car file because its packets do not contain them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "lidar/laser.hpp"

namespace iog::lidar {

// The rotation mode of an Ouster.
struct TurnMode {
  std::uint16_t columns_per_turn = 0;
  std::uint16_t turns_per_second = 0;

  [[nodiscard]] constexpr bool is_valid() const;
  // The time from one column to the next, rounded down. The mode must be valid.
  [[nodiscard]] constexpr std::uint32_t column_ns() const {
    return 1'000'000'000U / (std::uint32_t{columns_per_turn} * turns_per_second);
  }
  friend constexpr bool operator==(const TurnMode&, const TurnMode&) = default;
};

// The modes to which an Ouster can be set.
inline constexpr std::array<TurnMode, 5> kTurnModes{
    {{512, 10}, {1024, 10}, {2048, 10}, {512, 20}, {1024, 20}}};

constexpr bool TurnMode::is_valid() const {
  return std::ranges::find(kTurnModes, *this) != kTurnModes.end();
}

struct Unit {
  // One correction per layer, or none. If the packets of a format do not contain the number of
  // layers, it is the size of this span. The storage must be static or must outlive the packets.
  std::span<const LaserCorrection> corrections{};
  // Only for units whose points contain their own elevations: the elevations of the layers in
  // ascending order, in units of 1/3,200 degree. The storage must also be static or outlive the
  // packets.
  std::span<const std::int32_t> elevations{};
  // Used for formats whose packets do not contain these two values.
  std::uint16_t columns_per_turn = 0;
  std::uint32_t column_ns = 0;
};

}  // namespace iog::lidar
