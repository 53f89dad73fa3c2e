// The bits of a tile's evidence are what its bytes say (placing/slice_byte.hpp).
#include "placing/evidence_bits.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "placing/slice_byte.hpp"

namespace iog::placing {
namespace {

TEST(EvidenceBits, AreWhatTheBytesSay) {
  tests::Random random(14);
  for (int round = 0; round < 200; ++round) {
    alignas(32) FrameEvidence::TileIndexes tile{};
    window::Plane hit{};
    window::Plane free{};
    window::Plane from_below{};
    const int said_in = random.between(1, 60);
    for (std::size_t i = 0; i < tile.size(); ++i) {
      const int index = random.one_in(said_in) ? random.between(-kMostIndex, kMostIndex) : 0;
      const bool has_bit = random.one_in(2);
      tile[i] = byte_of(index, has_bit);
      const std::uint32_t bit = 1U << i % geometry::kTileSide;
      const std::size_t y = i / geometry::kTileSide;
      hit[y] |= index > 0 ? bit : 0U;
      free[y] |= index < 0 ? bit : 0U;
      from_below[y] |= index < 0 && has_bit ? bit : 0U;
    }
    const EvidenceBits bits = bits_of(tile);
    ASSERT_EQ(bits.hit, hit) << round;
    ASSERT_EQ(bits.free, free) << round;
    ASSERT_EQ(bits.from_below, from_below) << round;
  }
}

}  // namespace
}  // namespace iog::placing
