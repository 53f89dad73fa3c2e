// The map state in the class end message (docs/spec.md 3.10). The map state describes the block in
// use and its transform, the reasons why the map had no effect, and the transfer of the next block.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "map/block.hpp"
#include "map/delivery.hpp"
#include "map/layer_report.hpp"

namespace iog::stream {

// The maximum number of bytes in an attribution. A longer attribution is truncated at a character
// boundary.
inline constexpr std::size_t kMaxShownAttribution = 96;

// Describes the block in use, but does not contain its CRC.
struct MapInUse {
  std::uint8_t source = 0;  // map::Source
  std::uint8_t attribution_bytes = 0;
  std::array<char, kMaxShownAttribution> attribution{};  // UTF-8

  [[nodiscard]] std::string_view words() const { return {attribution.data(), attribution_bytes}; }
  void set_words(std::string_view text);
  friend constexpr bool operator==(const MapInUse&, const MapInUse&) = default;
};
[[nodiscard]] MapInUse in_use(const map::Block& block);

struct MapState {
  std::optional<MapInUse> in_use{};
  map::LayerReport layer{};  // fields that describe only one frame are not sent
  map::DeliveryReport delivery{};
};

// Returns the number of bytes written, or 0 if the buffer is too small.
std::size_t write_map_state(const MapState& state, std::span<std::byte> buffer);

// Returns std::nullopt if the map state is too short. Skips fields that a later version may append.
[[nodiscard]] std::optional<MapState> read_map_state(std::span<const std::byte> bytes);

}  // namespace iog::stream
