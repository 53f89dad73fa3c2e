// Encodings 1 to 3, which targets of interface version 3 send: runs and blocks of one value. They
// are read, and no longer written (docs/spec.md 3.4).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

// Runs of one value, or as in the reference if there is one. False if the payload is malformed; the
// cells then are of no use.
[[nodiscard]] bool decode_run_length(std::span<const std::byte> payload,
                                     const std::optional<TileCells>& reference,
                                     MutableTileCells cells);

// Blocks of one value, in Morton order.
[[nodiscard]] bool decode_quadtree(std::span<const std::byte> payload, MutableTileCells cells);

}  // namespace iog::tile_coding
