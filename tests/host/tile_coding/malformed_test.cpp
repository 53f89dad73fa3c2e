// What a receiver must survive: payloads that no encoder writes.
#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "tile_coding/decode.hpp"
#include "tile_coding/encode.hpp"
#include "tiles.hpp"

namespace iog::tile_coding {
namespace {

using Bytes = std::vector<std::byte>;

DecodeStatus decoded(Encoding encoding, const Bytes& payload,
                     const std::optional<Reference>& reference = std::nullopt) {
  Tile cells{};
  return decode(encoding, payload, reference, cells);
}

Bytes coded(const Tile& tile, Encoding encoding, const std::optional<Reference>& reference) {
  static Encoder encoder;
  Tile payload{};
  const EncodedTile result = encoder.encode_as(encoding, tile, reference, payload);
  return {payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(result.bytes)};
}

TEST(Malformed, APayloadThatIsCutOrHasATailIsRefused) {
  tests::Random random(95);
  const Tile before = rectangles(random);
  const Tile tile = changed(before, random);
  const Reference reference{.cells = before, .frame_number = 7};
  for (std::size_t i = 0; i < kEncodingCount; ++i) {
    const auto encoding = static_cast<Encoding>(i);
    const Bytes payload = coded(tile, encoding, reference);
    for (std::size_t size = 0; size < payload.size(); ++size) {
      const Bytes cut(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_EQ(decoded(encoding, cut, reference), DecodeStatus::kMalformed);
    }
    Bytes longer = payload;
    longer.push_back(std::byte{0});
    ASSERT_EQ(decoded(encoding, longer, reference), DecodeStatus::kMalformed);
  }
}

TEST(Malformed, TheIndexThatDoesNotExistIsRefused) {
  Bytes raw(kTileBytes);
  EXPECT_EQ(decoded(Encoding::kRaw, raw), DecodeStatus::kOk);
  raw.at(1'000) = kNoIndex;
  EXPECT_EQ(decoded(Encoding::kRaw, raw), DecodeStatus::kMalformed);
  Bytes flat{std::byte{1}, std::byte{127}, std::byte{0}};
  EXPECT_EQ(decoded(Encoding::kQuadtree, flat), DecodeStatus::kOk);
  flat.at(1) = kNoIndex;
  EXPECT_EQ(decoded(Encoding::kQuadtree, flat), DecodeStatus::kMalformed);
}

TEST(Malformed, ARunBeyondTheTileIsRefused) {
  // 1025 cells: ten zeros, 10000000001.
  const Bytes payload{std::byte{1}, std::byte{0}, std::byte{0x00}, std::byte{0x20},
                      std::byte{0x08}};
  EXPECT_EQ(decoded(Encoding::kRunLength, payload), DecodeStatus::kMalformed);
}

TEST(Malformed, TilesWithoutValuesAreRefused) {
  EXPECT_EQ(decoded(Encoding::kRunLength, {std::byte{0}, std::byte{0}}), DecodeStatus::kMalformed);
  EXPECT_EQ(decoded(Encoding::kQuadtree, {std::byte{0}, std::byte{0}}), DecodeStatus::kMalformed);
}

TEST(Malformed, AnotherReferenceIsSaid) {
  const Tile tile = flat_tile(3);
  const Bytes payload =
      coded(tile, Encoding::kChangedSince, Reference{.cells = tile, .frame_number = 7});
  EXPECT_EQ(reference_frame(payload), 7U);
  EXPECT_EQ(decoded(Encoding::kChangedSince, payload), DecodeStatus::kUnknownReference);
  EXPECT_EQ(decoded(Encoding::kChangedSince, payload, Reference{.cells = tile, .frame_number = 8}),
            DecodeStatus::kUnknownReference);
}

TEST(Malformed, AnotherEncodingIsSaid) {
  EXPECT_EQ(decoded(static_cast<Encoding>(4), {}), DecodeStatus::kUnknownEncoding);
  EXPECT_EQ(decoded(static_cast<Encoding>(255), Bytes(kTileBytes)), DecodeStatus::kUnknownEncoding);
}

// Noise, and payloads with a few bytes changed: whatever is taken for a tile is one.
TEST(Malformed, DecodingIsTotalOnGarbage) {
  tests::Random random(96);
  const Tile before = rectangles(random);
  const Reference reference{.cells = before, .frame_number = 0};
  for (int i = 0; i < tests::effort(50'000, 500); ++i) {
    const auto encoding = static_cast<Encoding>(random.between(0, 3));
    Bytes payload = random.one_in(2) ? coded(changed(before, random), encoding, reference)
                                     : Bytes(random.below(64));
    for (int changes = random.between(1, 8); changes > 0 && !payload.empty(); --changes) {
      payload.at(random.below(payload.size())) = static_cast<std::byte>(random.next());
    }
    Tile cells{};
    if (decode(encoding, payload, reference, cells) == DecodeStatus::kOk) {
      ASSERT_EQ(std::ranges::count(cells, kNoIndex), 0);
    }
  }
}

}  // namespace
}  // namespace iog::tile_coding
