// Payloads that no encoder writes.
#include "tools/frames/tile_decoding.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "fakes/bytes_of.hpp"
#include "fakes/effort.hpp"
#include "tile_coding/tiles.hpp"

namespace iog::tile_coding {
namespace {

using tests::Bytes;
using tests::bytes_of;
using tests::joined;

constexpr std::uint32_t kFrame = 7;

DecodeStatus decoded(Encoding encoding, const Bytes& payload,
                     const std::optional<Reference>& reference = std::nullopt) {
  Tile cells{};
  return decode(encoding, payload, kFrame, reference, cells);
}

Bytes coded(const Tile& tile, const std::optional<Reference>& reference) {
  static Encoder encoder;
  Tile payload{};
  const EncodedTile result = encoder.encode(tile, kFrame, reference, payload);
  return {payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(result.bytes)};
}

TEST(Malformed, APayloadThatIsCutOrHasATailIsRefused) {
  tests::Random random(95);
  const Tile before = rectangles(random);
  const Tile tile = changed(before, random);
  const Reference reference{.cells = before, .frame_number = 3};
  for (const auto& [encoding, payload] :
       {std::pair(Encoding::kRunStarts, coded(tile, std::nullopt)),
        std::pair(Encoding::kRunStartsSince, coded(tile, reference)),
        std::pair(Encoding::kRaw, Bytes(kTileBytes))}) {
    ASSERT_EQ(decoded(encoding, payload, reference), DecodeStatus::kOk);
    for (std::size_t size = 0; size < payload.size(); ++size) {
      const Bytes cut(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_EQ(decoded(encoding, cut, reference), DecodeStatus::kMalformed);
    }
    Bytes longer = payload;
    longer.push_back(std::byte{0});
    ASSERT_EQ(decoded(encoding, longer, reference), DecodeStatus::kMalformed);
  }
}

// Sixteen bytes of bits, the first of them given.
Bytes sets(std::initializer_list<int> first) {
  Bytes bytes = bytes_of(first);
  bytes.resize(16);
  return bytes;
}

TEST(Malformed, TheIndexThatDoesNotExistIsRefused) {
  Bytes raw(kTileBytes);
  raw.at(1'000) = kNoIndex;
  EXPECT_EQ(decoded(Encoding::kRaw, raw), DecodeStatus::kMalformed);
  const auto flat = [](int value) {
    return joined({bytes_of({1, value}), sets({1}), bytes_of({1})});
  };
  EXPECT_EQ(decoded(Encoding::kRunStarts, flat(127)), DecodeStatus::kOk);
  EXPECT_EQ(decoded(Encoding::kRunStarts, flat(-128)), DecodeStatus::kMalformed);
}

TEST(Malformed, ABlockInWhichNoRunStartsIsNone) {
  const Bytes payload = joined({bytes_of({1, 5}), sets({1}), bytes_of({0})});
  EXPECT_EQ(decoded(Encoding::kRunStarts, payload), DecodeStatus::kMalformed);
}

// Four runs of three alternatives are 7 bits: 3^4 = 81 is below 128.
TEST(Malformed, ANumberIsNoMoreThanItsDigits) {
  const auto payload = [](int number) {
    return joined({bytes_of({3, 1, 2, 3}), sets({1}), bytes_of({0xF, number << 1})});
  };
  EXPECT_EQ(decoded(Encoding::kRunStarts, payload(80)), DecodeStatus::kOk);
  EXPECT_EQ(decoded(Encoding::kRunStarts, payload(81)), DecodeStatus::kMalformed);
}

// The same with three runs: the fourth digit is a 0.
TEST(Malformed, ThereIsNoSymbolBehindTheLastRun) {
  const auto payload = [](int number) {
    return joined({bytes_of({3, 1, 2, 3}), sets({1}), bytes_of({0x7, number << 1})});
  };
  EXPECT_EQ(decoded(Encoding::kRunStarts, payload(78)), DecodeStatus::kOk);
  EXPECT_EQ(decoded(Encoding::kRunStarts, payload(79)), DecodeStatus::kMalformed);
}

TEST(Malformed, ThereAreNoMoreValuesThanFourDigitsFit) {
  Bytes payload = bytes_of({216});
  for (int value = 0; value < 216; ++value) {
    payload.push_back(static_cast<std::byte>(value < 127 ? value + 1 : value + 2));
  }
  payload = joined({payload, sets({1}), bytes_of({1, 0, 0, 0, 0})});
  EXPECT_EQ(decoded(Encoding::kRunStarts, payload), DecodeStatus::kMalformed);
}

TEST(Malformed, AnotherReferenceIsSaid) {
  const Tile tile = flat_tile(3);
  const Bytes payload = bytes_of({4, 0});
  EXPECT_EQ(reference_frame(Encoding::kRunStartsSince, payload, kFrame), 3U);
  EXPECT_EQ(reference_frame(Encoding::kRunStartsSince, {}, kFrame), std::nullopt);
  EXPECT_EQ(reference_frame(Encoding::kRunStarts, payload, kFrame), std::nullopt);
  const auto against = [&](std::uint32_t frame_number) {
    return decoded(Encoding::kRunStartsSince, payload,
                   Reference{.cells = tile, .frame_number = frame_number});
  };
  EXPECT_EQ(decoded(Encoding::kRunStartsSince, payload), DecodeStatus::kUnknownReference);
  EXPECT_EQ(against(2), DecodeStatus::kUnknownReference);
  EXPECT_EQ(against(3), DecodeStatus::kOk);
}

TEST(Malformed, AnotherEncodingIsSaid) {
  for (const int other : {1, 2, 3, 6, 255}) {
    EXPECT_EQ(decoded(static_cast<Encoding>(other), Bytes(kTileBytes)),
              DecodeStatus::kUnknownEncoding);
  }
}

// Noise, and payloads with a few bytes changed: whatever is taken for a tile is one.
TEST(Malformed, DecodingIsTotalOnGarbage) {
  tests::Random random(96);
  const Tile before = rectangles(random);
  const Reference reference{.cells = before, .frame_number = 0};
  for (int i = 0; i < tests::effort(50'000, 500); ++i) {
    const auto encoding = static_cast<Encoding>(random.between(0, kEncodingCount - 1));
    const bool is_since = encoding == Encoding::kRunStartsSince;
    Bytes payload = random.one_in(2) ? coded(changed(before, random),
                                             is_since ? std::optional(reference) : std::nullopt)
                                     : Bytes(random.below(64));
    for (int changes = random.between(1, 8); changes > 0 && !payload.empty(); --changes) {
      payload.at(random.below(payload.size())) = static_cast<std::byte>(random.next());
    }
    Tile cells{};
    if (decode(encoding, payload, kFrame, reference, cells) == DecodeStatus::kOk) {
      ASSERT_EQ(std::ranges::count(cells, kNoIndex), 0);
    }
  }
}

}  // namespace
}  // namespace iog::tile_coding
