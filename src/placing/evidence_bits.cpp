#include "placing/evidence_bits.hpp"

#include "placing/slice_byte.hpp"

namespace iog::placing {

EvidenceBits bits_of(const FrameEvidence::TileIndexes& tile) {
  constexpr std::size_t kSide = geometry::kTileSide;
  EvidenceBits bits{};
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const std::uint32_t bit = 1U << i % kSide;
    bits.hit[i / kSide] |= tile[i] > 0 ? bit : 0U;
    bits.free[i / kSide] |= tile[i] < 0 ? bit : 0U;
    bits.from_below[i / kSide] |= is_from_below(tile[i]) ? bit : 0U;
  }
  return bits;
}

}  // namespace iog::placing
