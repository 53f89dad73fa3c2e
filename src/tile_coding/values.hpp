// The list of values with which most payloads begin: u8 how many, then each, int8.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

struct Values {
  std::span<const std::byte> list;
  std::span<const std::byte> rest;  // of the payload
};

// Takes them from the front of the payload; nothing if it is too short, or has a value that is
// none.
[[nodiscard]] inline std::optional<Values> take_values(std::span<const std::byte> payload) {
  if (payload.empty()) {
    return std::nullopt;
  }
  const auto count = std::to_integer<std::size_t>(payload[0]);
  if (payload.size() < 1 + count) {
    return std::nullopt;
  }
  const auto list = payload.subspan(1, count);
  if (std::ranges::find(list, kNoIndex) != list.end()) {
    return std::nullopt;
  }
  return Values{.list = list, .rest = payload.subspan(1 + count)};
}

}  // namespace iog::tile_coding
