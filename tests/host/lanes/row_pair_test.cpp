// Two rows at once do what two rows one after the other do.
#include <array>
#include <cstdint>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "lanes/lanes.hpp"

namespace iog::lanes {
namespace {

using Words = std::array<std::uint64_t, 2>;

Words words_of(RowPair pair) {
  Words words{};
  pair.store(words.data());
  return words;
}

template <int kBits>
void expect_shifts(const Words& words) {
  const RowPair pair = RowPair::load(words.data());
  EXPECT_EQ(words_of(pair.up<kBits>()), (Words{words[0] << kBits, words[1] << kBits}));
  EXPECT_EQ(words_of(pair.down<kBits>()), (Words{words[0] >> kBits, words[1] >> kBits}));
}

TEST(RowPair, DoesBothRowsAtOnce) {
  tests::Random random(9);
  for (int i = 0; i < 200; ++i) {
    const Words a{random.next(), random.next()};
    const Words b{random.next(), random.next()};
    const RowPair pair = RowPair::load(a.data());
    const RowPair other = RowPair::load(b.data());
    EXPECT_EQ(words_of(pair), a);
    EXPECT_EQ(words_of(pair.bit_and(other)), (Words{a[0] & b[0], a[1] & b[1]}));
    EXPECT_EQ(words_of(pair.bit_or(other)), (Words{a[0] | b[0], a[1] | b[1]}));
    EXPECT_EQ(words_of(pair.and_not(other)), (Words{a[0] & ~b[0], a[1] & ~b[1]}));
    expect_shifts<1>(a);
    expect_shifts<2>(a);
    expect_shifts<3>(a);
    std::array<std::uint32_t, 2> middle{};
    pair.store_middle(middle.data());
    EXPECT_EQ(middle[0], static_cast<std::uint32_t>(a[0] >> 16));
    EXPECT_EQ(middle[1], static_cast<std::uint32_t>(a[1] >> 16));
  }
}

// Rows begin at any multiple of eight bytes.
TEST(RowPair, LoadsTwoRowsThatFollowEachOther) {
  alignas(16) const std::array<std::uint64_t, 3> rows{1, 2, 3};
  EXPECT_EQ(words_of(RowPair::load(&rows[1])), (Words{2, 3}));
}

}  // namespace
}  // namespace iog::lanes
