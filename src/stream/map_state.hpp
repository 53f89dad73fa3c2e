// What the end of a frame's classes says of the map (docs/spec.md 3.10): which block is in use, by
// which transform, why cells have no class of it, and what comes of the next block.
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

// Longer ones are cut at a character.
inline constexpr std::size_t kMaxShownAttribution = 96;

// Of a block in use, beside its name.
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
  map::LayerReport layer{};  // but for what is of its frame alone
  map::DeliveryReport delivery{};
};

// Returns the bytes written, 0 if the buffer is too small.
std::size_t write_map_state(const MapState& state, std::span<std::byte> buffer);

// What is behind the fields of this version is skipped. Empty: too short, or says so.
[[nodiscard]] std::optional<MapState> read_map_state(std::span<const std::byte> bytes);

}  // namespace iog::stream
