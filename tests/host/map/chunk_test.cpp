#include "map/chunk.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/chunk_bytes.hpp"
#include "fakes/random.hpp"

namespace iog::map {
namespace {

using tests::ChunkBytes;

std::vector<std::byte> some_bytes(std::size_t count, std::uint64_t seed = 1) {
  tests::Random random(seed);
  std::vector<std::byte> bytes(count);
  std::ranges::generate(bytes, [&] { return static_cast<std::byte>(random.next()); });
  return bytes;
}

Fate fate_of(ChunkBytes& bytes) { return decode_chunk(bytes.seal().bytes()).fate; }

TEST(MapChunk, IsWrittenAsTheSpecificationSays) {
  const std::vector<std::byte> block = some_bytes(3'000);
  const std::span all(block);
  ChunkEncoder encoder;
  EXPECT_TRUE(
      std::ranges::equal(encoder.encode(chunk_of(0xCAFEBABE, block, 1)),
                         ChunkBytes(0xCAFEBABE, 3'000, 1'280, all.subspan(1'280, 1'280)).bytes()));
  ChunkBytes last(0xCAFEBABE, 3'000, 2'560, all.last(440));
  last.put(10, 2, 2).put(18, 2, 1).seal();  // session and counter go on
  EXPECT_TRUE(std::ranges::equal(encoder.encode(chunk_of(0xCAFEBABE, block, 2)), last.bytes()));
}

TEST(MapChunk, IsReadAsTheSpecificationSays) {
  const std::vector<std::byte> piece = some_bytes(440);
  const ChunkBytes bytes(0xCAFEBABE, 3'000, 2'560, piece);
  const DecodedChunk decoded = decode_chunk(bytes.bytes());
  ASSERT_EQ(decoded.fate, Fate::kTaken);
  EXPECT_EQ(decoded.chunk.block, (BlockName{.crc = 0xCAFEBABE, .bytes = 3'000}));
  EXPECT_EQ(decoded.chunk.offset, 2'560U);
  EXPECT_EQ(decoded.chunk.number(), 2U);
  EXPECT_TRUE(std::ranges::equal(decoded.chunk.bytes, piece));
}

// The chunks of a block are all of it, end to end.
TEST(MapChunk, ChunksTileTheBlock) {
  for (const std::size_t size : {1UL, 1'279UL, 1'280UL, 1'281UL, 2'560UL, 100'000UL}) {
    const std::vector<std::byte> block = some_bytes(size, size);
    const BlockName name{.crc = 1, .bytes = static_cast<std::uint32_t>(size)};
    std::vector<std::byte> joined;
    ChunkEncoder encoder;
    for (std::size_t i = 0; i < chunk_count(name); ++i) {
      const auto message = encoder.encode(chunk_of(1, block, i));
      const DecodedChunk decoded = decode_chunk(message);
      ASSERT_EQ(decoded.fate, Fate::kTaken);
      ASSERT_EQ(decoded.chunk.offset, joined.size());
      joined.insert(joined.end(), decoded.chunk.bytes.begin(), decoded.chunk.bytes.end());
    }
    EXPECT_EQ(joined, block);
  }
}

// A later version may have a longer header; the piece is behind it.
TEST(MapChunk, LongerHeaderIsSkipped) {
  ChunkBytes bytes;
  bytes.resize(62).put(30, 2, 24).put(58, 4, 0x01020304);
  ASSERT_EQ(fate_of(bytes), Fate::kTaken);
  EXPECT_EQ(decode_chunk(bytes.bytes()).chunk.bytes.front(), std::byte{0x55});
  EXPECT_EQ(decode_chunk(bytes.bytes()).chunk.bytes.back(), std::byte{0x04});
}

struct Fault {
  const char* what;
  std::size_t offset;
  std::size_t size;
  std::int64_t value;
  Fate fate;
};

// One field at a time, in a message whose CRC is right.
TEST(MapChunk, EveryFaultHasItsName) {
  const std::vector<Fault> faults{{"another service", 0, 2, 0x4F48, Fate::kNotOurs},
                                  {"the event of poses", 2, 2, 0x8003, Fate::kNotOurs},
                                  {"a request", 14, 1, 0, Fate::kNotOurs},
                                  {"another protocol version", 12, 1, 2, Fate::kNotOurs},
                                  {"another interface version", 13, 1, 2, Fate::kWrongVersion},
                                  {"another content version", 28, 1, 2, Fate::kWrongVersion},
                                  {"SOME/IP too long", 4, 4, 51, Fate::kDamaged},
                                  {"E2E too short", 16, 2, 49, Fate::kDamaged},
                                  {"the data id of poses", 20, 4, 0x494F4703, Fate::kDamaged},
                                  {"header too short", 30, 2, 19, Fate::kWrongLength},
                                  {"header longer than the content", 30, 2, 31, Fate::kWrongLength},
                                  {"header into the piece", 30, 2, 21, Fate::kWrongLength},
                                  {"more bytes than there are", 44, 2, 11, Fate::kWrongLength},
                                  {"fewer bytes than there are", 44, 2, 9, Fate::kWrongLength},
                                  {"fewer than the block has", 36, 4, 11, Fate::kWrongLength},
                                  {"more than the block has", 36, 4, 9, Fate::kWrongLength},
                                  {"a reserved byte", 29, 1, 1, Fate::kNotZero},
                                  {"reserved bytes", 46, 2, 1, Fate::kNotZero},
                                  {"no block", 36, 4, 0, Fate::kOutOfRange},
                                  {"a block above 4 MiB", 36, 4, 4'194'305, Fate::kOutOfRange},
                                  {"the longest number", 36, 4, 0xFFFFFFFF, Fate::kOutOfRange},
                                  {"an offset between chunks", 40, 4, 1, Fate::kOutOfRange},
                                  {"behind the block", 40, 4, 1'280, Fate::kOutOfRange},
                                  {"far behind the block", 40, 4, 0xFFFFFF00, Fate::kOutOfRange}};
  for (const Fault& fault : faults) {
    ChunkBytes bytes;
    EXPECT_EQ(fate_of(bytes.put(fault.offset, fault.size, fault.value)), fault.fate) << fault.what;
  }
}

TEST(MapChunk, TheLastOfTheLongestBlock) {
  // 4 MiB are 3276 chunks and 1024 bytes.
  const ChunkBytes last(7, 4'194'304, 3'276 * 1'280, some_bytes(1'024));
  EXPECT_EQ(decode_chunk(last.bytes()).fate, Fate::kTaken);
  EXPECT_EQ(decode_chunk(last.bytes()).chunk.number() + 1, kMaxChunks);
}

TEST(MapChunk, EveryFlippedBitAndEveryCutIsFound) {
  const std::vector<std::byte> sound = ChunkBytes().bytes();
  for (std::size_t bit = 0; bit < sound.size() * 8; ++bit) {
    std::vector<std::byte> bytes = sound;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_NE(decode_chunk(bytes).fate, Fate::kTaken) << bit;
  }
  for (std::size_t length = 0; length < sound.size(); ++length) {
    EXPECT_NE(decode_chunk(std::span(sound).first(length)).fate, Fate::kTaken) << length;
  }
}

TEST(MapChunk, AnyBytesAreOnlyRead) {
  tests::Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    EXPECT_NE(decode_chunk(some_bytes(random.below(1'500), random.next())).fate, Fate::kTaken);
  }
}

}  // namespace
}  // namespace iog::map
