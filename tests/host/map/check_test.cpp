// What is refused, and by which name (docs/spec.md, section 6.4). Each block is sound but for one
// thing, and has the right CRC of that.
#include <cstdint>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/reference_block.hpp"
#include "map/block.hpp"

namespace iog::map {
namespace {

using tests::put;
using tests::ReferenceBlock;
using tests::sealed;

// Two houses, the first in two buckets and with a hole.
ReferenceBlock sound() {
  return {.features = {{Kind::kBuilding,
                        {{{-3'000, 0}, {-2'000, 0}, {-2'000, 900}, {-3'000, 900}},
                         {{-2'900, 100}, {-2'100, 100}, {-2'500, 800}}}},
                       {Kind::kRoad, {{{4'000, 3'000}, {5'000, 3'000}, {4'500, 4'000}}}}}};
}

// The refusal of the sound block with `count` bytes at `at` changed.
Refusal with(std::size_t at, std::uint64_t value, int count) {
  auto bytes = sound().bytes();
  put(bytes, at, value, count);
  return check(sealed(std::move(bytes)));
}

std::size_t first_feature() { return sound().features_at(); }
std::size_t second_feature() { return first_feature() + 24 + 12 + 3 * 4 + 12 + 2 * 4; }

TEST(MapCheck, PassesWhatIsSound) { EXPECT_EQ(check(sound().bytes()), Refusal::kNone); }

// In pieces of any size the verdict is the same, and comes.
TEST(MapCheck, MayBeDoneInPieces) {
  const auto bytes = sound().bytes();
  auto wrong = bytes;
  put(wrong, first_feature() + 8, 0, 4);
  for (const auto& block : {bytes, sealed(wrong)}) {
    for (const std::size_t budget : {std::size_t{1}, std::size_t{7}, std::size_t{1'000'000}}) {
      Check pieces(block);
      std::size_t calls = 1;
      while (!pieces.advance(budget)) {
        ASSERT_LT(++calls, 10 * bytes.size());
      }
      EXPECT_EQ(pieces.verdict(), check(block)) << budget;
    }
  }
}

TEST(MapCheck, SeesEveryDamagedByte) {
  const auto bytes = sound().bytes();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    auto damaged = bytes;
    damaged[i] ^= 0x10;
    EXPECT_NE(check(damaged), Refusal::kNone) << i;
    if (i >= 12) {
      EXPECT_EQ(check(damaged), Refusal::kDamaged) << i;
    }
  }
}

TEST(MapCheck, SeesEveryMissingByte) {
  const auto bytes = sound().bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto refusal = check(std::span(bytes).first(size));
    EXPECT_EQ(refusal, size < 64 ? Refusal::kTooShort : Refusal::kWrongLength) << size;
  }
}

// Whatever a writer with the right CRC says of sizes and places, nothing beyond the bytes is read;
// the sanitizers watch.
TEST(MapCheck, BelievesNoNumber) {
  const std::size_t size = sound().bytes().size();
  for (std::size_t at = 0; at + 4 <= size; ++at) {
    for (const std::uint32_t value : {0U, 1U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU, 65'536U}) {
      auto bytes = sound().bytes();
      put(bytes, at, value, 4);
      bytes = sealed(std::move(bytes));
      if (check(bytes) == Refusal::kNone) {
        const Block block(bytes);
        std::size_t edges = 0;
        block.for_each_feature_in(block.extent(), [&](const Feature& feature) {
          feature.for_each_edge([&](PointCm, PointCm) { ++edges; });
        });
        EXPECT_EQ(edges, 10U) << at;
      }
    }
  }
}

TEST(MapCheck, RefusesWrongEnvelopes) {
  EXPECT_EQ(with(0, 0x494F4747, 4), Refusal::kNotABlock);
  EXPECT_EQ(with(4, 2, 2), Refusal::kWrongVersion);
  EXPECT_EQ(check(std::vector<std::uint8_t>(kMaxBlockBytes + 1)), Refusal::kTooLong);
  auto bytes = sound().bytes();
  put(bytes, 8, bytes.size() - 4, 4);
  EXPECT_EQ(check(bytes), Refusal::kWrongLength);
}

TEST(MapCheck, RefusesWrongHeaders) {
  EXPECT_EQ(with(6, 0, 1), Refusal::kWrongSource);
  EXPECT_EQ(with(6, 3, 1), Refusal::kWrongSource);
  EXPECT_EQ(with(7, 0, 1), Refusal::kWrongSource);
  EXPECT_EQ(with(16, 90'000'000'000, 8), Refusal::kNone);
  EXPECT_EQ(with(16, 90'000'000'001, 8), Refusal::kWrongOrigin);
  EXPECT_EQ(with(24, static_cast<std::uint64_t>(-180'000'000'000), 8), Refusal::kNone);
  EXPECT_EQ(with(24, static_cast<std::uint64_t>(-180'000'000'001), 8), Refusal::kWrongOrigin);
  EXPECT_EQ(with(32, 5'000, 4), Refusal::kWrongExtent) << "empty";
  EXPECT_EQ(with(44, 8'388'609, 4), Refusal::kWrongExtent) << "too far";
  EXPECT_EQ(with(32, 0x80000000, 4), Refusal::kWrongExtent);
  EXPECT_EQ(with(52, 0, 4), Refusal::kWrongAccuracy);
  EXPECT_EQ(with(52, 65'536, 4), Refusal::kWrongAccuracy);
  EXPECT_EQ(with(60, 0, 2), Refusal::kWrongText);
  EXPECT_EQ(with(60, 1'025, 2), Refusal::kWrongText);
  EXPECT_EQ(with(66, 0x1B, 1), Refusal::kWrongText) << "a terminal's escape";
  EXPECT_EQ(with(63, 1, 1), Refusal::kNotZero);
  EXPECT_EQ(with(71, 1, 1), Refusal::kNotZero) << "behind the text";
}

TEST(MapCheck, RefusesTablesThatDoNotFit) {
  EXPECT_EQ(with(56, 0x40000000, 4), Refusal::kWrongCounts) << "features";
  EXPECT_EQ(with(sound().entries_at() - 4, 0x40000000, 4), Refusal::kWrongCounts) << "entries";
  EXPECT_EQ(with(40, 8'388'608, 4), Refusal::kWrongCounts) << "buckets";
}

TEST(MapCheck, RefusesFeaturesThatDoNotLieEndToEnd) {
  const std::size_t offsets = sound().offsets_at();
  EXPECT_EQ(with(offsets, first_feature() + 4, 4), Refusal::kWrongOffsets);
  EXPECT_EQ(with(offsets + 4, second_feature() + 4, 4), Refusal::kWrongRing);
  EXPECT_EQ(with(offsets + 4, 0xFFFFFFFF, 4), Refusal::kWrongOffsets);
  EXPECT_EQ(with(offsets + 4, 0, 4), Refusal::kWrongOffsets);
  EXPECT_EQ(with(56, 1, 4), Refusal::kWrongOffsets) << "what stands behind the last one";
  EXPECT_EQ(with(offsets + 4, first_feature() + 20, 4), Refusal::kWrongOffsets)
      << "its header has 24 bytes";
  auto bytes = sound().bytes();
  bytes.resize(bytes.size() + 4);
  EXPECT_EQ(check(sealed(bytes)), Refusal::kWrongRing);
}

TEST(MapCheck, RefusesWrongFeatures) {
  const std::size_t feature = first_feature();
  EXPECT_EQ(with(feature, 3, 1), Refusal::kWrongKind);
  EXPECT_EQ(with(feature, 0, 1), Refusal::kWrongKind);
  EXPECT_EQ(with(feature + 1, 1, 1), Refusal::kNotZero);
  EXPECT_EQ(with(feature + 2, 0, 2), Refusal::kWrongRing);
  EXPECT_EQ(with(feature + 2, 3, 2), Refusal::kWrongRing);
  EXPECT_EQ(with(feature + 4, 8, 4), Refusal::kWrongRing) << "7 vertices";
  EXPECT_EQ(with(feature + 4, 65'536, 4), Refusal::kTooManyVertices);
  EXPECT_EQ(with(feature + 24, 2, 4), Refusal::kWrongRing);
  EXPECT_EQ(with(feature + 24, 0xFFFFFFFF, 4), Refusal::kWrongRing);
  EXPECT_EQ(with(feature + 8, static_cast<std::uint32_t>(-3'001), 4), Refusal::kWrongBox);
  EXPECT_EQ(with(feature + 16, static_cast<std::uint32_t>(-1'999), 4), Refusal::kWrongBox);
}

TEST(MapCheck, RefusesWhatReachesBeyondTheExtent) {
  EXPECT_EQ(with(second_feature() + 28, 4'001, 4), Refusal::kOutside) << "1 cm";
  EXPECT_EQ(with(second_feature() + 28, 0x7FFFFFFF, 4), Refusal::kOutside) << "an overflow";
  EXPECT_EQ(with(40, 4'999, 4), Refusal::kOutside) << "a smaller extent";
}

TEST(MapCheck, RefusesAnIndexThatIsNotThatOfTheBoxes) {
  const ReferenceBlock block = sound();
  // Buckets 0, 1 of row 1 (4,000 / 2,560) have feature 0, bucket 3 of rows 2 and 3 feature 1.
  const std::size_t starts = block.starts_at();
  const std::size_t entries = block.entries_at();
  EXPECT_EQ(with(starts, 1, 4), Refusal::kWrongIndex);
  EXPECT_EQ(with(starts + 4, 1, 4), Refusal::kWrongIndex) << "in a bucket that it does not meet";
  EXPECT_EQ(with(starts + 8, 0xFFFFFFFF, 4), Refusal::kWrongIndex);
  EXPECT_EQ(with(entries, 1, 4), Refusal::kWrongIndex) << "another feature";
  EXPECT_EQ(with(entries, 2, 4), Refusal::kWrongIndex) << "no such feature";
}

// A feature that one of its buckets does not name would be missed there.
TEST(MapCheck, RefusesAMissingEntry) {
  ReferenceBlock block = sound();
  auto bytes = block.bytes();
  const std::size_t gone = block.entries_at();
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(gone),
              bytes.begin() + static_cast<std::ptrdiff_t>(gone + 4));
  std::size_t first_named = 0;
  while (block.buckets()[first_named].empty()) {
    ++first_named;
  }
  std::size_t entries = 0;
  for (std::size_t bucket = 0; bucket < block.buckets().size(); ++bucket) {
    entries += block.buckets()[bucket].size();
    put(bytes, block.starts_at() + 4 * (bucket + 1), bucket >= first_named ? entries - 1 : 0, 4);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    put(bytes, block.offsets_at() - 4 + 4 * i, (i == 0 ? first_feature() : second_feature()) - 4,
        4);
  }
  EXPECT_EQ(check(sealed(bytes)), Refusal::kWrongIndex);
}

TEST(MapCheck, TakesTheLargestFeatureAndNoLarger) {
  for (const std::int32_t vertices : {65'535, 65'536}) {
    tests::ReferenceFeature comb{Kind::kBuilding, {{}}};
    for (std::int32_t i = 0; i < vertices; ++i) {
      comb.rings[0].push_back({i % 4'000, i / 4'000});
    }
    EXPECT_EQ(check(ReferenceBlock{.features = {comb}}.bytes()),
              vertices == 65'535 ? Refusal::kNone : Refusal::kTooManyVertices);
  }
}

}  // namespace
}  // namespace iog::map
