// Processes cells one by one. This is the specification; tile_runs_neon.cpp is its Cortex-A9 twin.
#include "tile_coding/tile_runs.hpp"

#include <algorithm>

namespace iog::tile_coding {

void TileRuns::find(TileCells cells, const std::optional<TileCells>& reference) {
  as_reference_ = reference ? std::to_integer<std::uint8_t>(kNoIndex) : std::uint8_t{0};
  starts_ = {};
  const std::span<std::byte> values = std::as_writable_bytes(std::span(values_));
  count_ = 0;
  bool is_of_value = false;  // the previous cell belongs to a run with a value
  for (std::size_t i = 0; i < kTileBytes; ++i) {
    const bool differs = cells[i] != (reference ? (*reference)[i] : std::byte{0});
    const bool changes = i > 0 && cells[i] != cells[i - 1];
    if (is_of_value ? changes : differs) {
      starts_[i / kTileSide] |= 1U << (i % kTileSide);
      values[count_++] = differs ? cells[i] : std::byte{as_reference_};
    }
    is_of_value = differs || (is_of_value && !changes);
  }
  std::ranges::fill(values.subspan(count_, 4), std::byte{as_reference_});
}

std::size_t TileRuns::write_starts(std::span<std::byte, kMostStartBytes> out) const {
  std::ranges::fill(out.first<kSets>(), std::byte{0});
  std::size_t bytes = kSets;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const std::size_t y = block / kBlocksPerRow * 2;
    const std::size_t x = block % kBlocksPerRow * 4;
    const std::uint32_t lower = starts_[y] >> x & 0xFU;
    const std::uint32_t upper = starts_[y + 1] >> x & 0xFU;
    if ((lower | upper) != 0) {
      out[block / 8] |= static_cast<std::byte>(1U << (block % 8));
      out[bytes++] = static_cast<std::byte>(lower | upper << 4);
    }
  }
  return bytes;
}

}  // namespace iog::tile_coding
