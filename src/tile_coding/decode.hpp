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

// Whatever the payload, writes `cells` and nothing else; they are a tile only if it returns kOk. It
// reads every payload once, in at most 1024 runs or blocks. `reference` is what the receiver has of
// this tile, for kChangedSince.
[[nodiscard]] DecodeStatus decode(Encoding encoding, std::span<const std::byte> payload,
                                  const std::optional<Reference>& reference,
                                  MutableTileCells cells);

// The frame against which a kChangedSince payload was written, if it is long enough to say.
[[nodiscard]] std::optional<std::uint32_t> reference_frame(std::span<const std::byte> payload);

}  // namespace iog::tile_coding
