// The properties of a unit that its packets do not contain. The car file specifies these
// properties.
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
  // Returns the time from one column to the next, rounded down. The mode must be valid.
  [[nodiscard]] constexpr std::uint32_t column_ns() const {
    return 1'000'000'000U / (std::uint32_t{columns_per_turn} * turns_per_second);
  }
  friend constexpr bool operator==(const TurnMode&, const TurnMode&) = default;
};

// The modes that an Ouster supports.
inline constexpr std::array<TurnMode, 5> kTurnModes{
    {{512, 10}, {1024, 10}, {2048, 10}, {512, 20}, {1024, 20}}};

constexpr bool TurnMode::is_valid() const {
  return std::ranges::find(kTurnModes, *this) != kTurnModes.end();
}

struct Unit {
  // One correction per layer, or an empty span. If the packets of a format do not contain the
  // number of layers, the size of this span determines it. The storage must be static or must
  // outlive the packets.
  std::span<const LaserCorrection> corrections{};
  // The elevations of the layers in ascending order, in units of 1/3,200 degree. The elevations are
  // used only for units whose points contain their own elevations. The storage must also be static
  // or outlive the packets.
  std::span<const std::int32_t> elevations{};
  // The following two values are used only for formats whose packets do not contain them.
  std::uint16_t columns_per_turn = 0;
  std::uint32_t column_ns = 0;
};

}  // namespace iog::lidar
