#include "tools/assembly/grid_frame.hpp"

#include <array>

#include "stream/grid_hash.hpp"

namespace iog::tools {

std::uint32_t grid_crc_of(const GridFrame& frame) {
  stream::GridHash hash;
  for (std::size_t tile = 0; tile < stream::kTileCount; ++tile) {
    if (!frame.known_tiles.test(tile)) {
      continue;
    }
    std::array<std::byte, stream::kTileBytes> cells{};
    for (std::size_t i = 0; i < stream::kTileBytes; ++i) {
      cells[i] = static_cast<std::byte>(frame.cells[cell_of_tile(tile, i)]);
    }
    hash.add(tile % stream::kTilesPerSide, tile / stream::kTilesPerSide, cells);
  }
  return hash.value();
}

}  // namespace iog::tools
