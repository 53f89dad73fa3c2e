#include "stream/references.hpp"

#include <algorithm>

namespace iog::stream {

void References::keep(std::size_t tile, tile_coding::TileCells cells, std::uint32_t frame_number,
                      std::size_t payload_bytes) {
  std::ranges::copy(cells, cells_[tile].begin());
  frame_numbers_[tile] = frame_number;
  payload_bytes_[tile] = static_cast<std::uint16_t>(payload_bytes);
  is_kept_[tile] = true;
  is_spent_[tile] = false;
}

void References::note_changes(std::size_t tile, std::size_t payload_bytes) {
  is_spent_[tile] = 8 * payload_bytes > std::size_t{7} * payload_bytes_[tile];
}

std::optional<tile_coding::Reference> References::find(std::size_t tile) const {
  if (!is_kept_[tile]) {
    return std::nullopt;
  }
  return tile_coding::Reference{.cells = cells_[tile], .frame_number = frame_numbers_[tile]};
}

std::optional<tile_coding::Reference> References::usable(std::size_t tile,
                                                         std::uint32_t frame_number) const {
  constexpr std::uint32_t kPeriod = kMaxReferenceAge + 1;
  const auto number = static_cast<std::uint32_t>(tile);
  const bool is_its_turn = (frame_number + number) % kPeriod == 0;
  const bool is_old = frame_number - frame_numbers_[tile] > kMaxReferenceAge;
  return is_its_turn || is_old || is_spent_[tile] ? std::nullopt : find(tile);
}

}  // namespace iog::stream
