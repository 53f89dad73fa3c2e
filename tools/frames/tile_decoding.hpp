// From a tile's payload back to its cells.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tile_coding/encode.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

enum class DecodeStatus : std::uint8_t {
  kOk,
  kUnknownEncoding,
  kMalformed,         // not what an encoder writes: too short, too long, or meaningless inside
  kUnknownReference,  // against another frame than the one at hand
};

// Decodes any payload: it writes `cells` and nothing else, reads the payload once, and takes at
// most 1024 runs or blocks. The cells are a tile only if it returns kOk. frame_number: of the
// message. `reference` is the tile that the receiver keeps.
[[nodiscard]] DecodeStatus decode(Encoding encoding, std::span<const std::byte> payload,
                                  std::uint32_t frame_number,
                                  const std::optional<Reference>& reference,
                                  MutableTileCells cells);

// The frame to which a payload refers, if its encoding refers to one, and it is long enough to say.
[[nodiscard]] std::optional<std::uint32_t> reference_frame(Encoding encoding,
                                                           std::span<const std::byte> payload,
                                                           std::uint32_t frame_number);

}  // namespace iog::tile_coding
