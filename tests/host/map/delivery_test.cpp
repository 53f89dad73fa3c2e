#include "map/delivery.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>
#include <vector>

#include "fakes/chunk_bytes.hpp"
#include "fakes/random.hpp"
#include "fakes/reference_block.hpp"

namespace iog::map {
namespace {

using tests::crc_of;
using tests::ReferenceBlock;
using tests::sealed;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kSender = 0x0A00026F;
constexpr std::uint32_t kPeer = 0x0A000202;
constexpr std::uint64_t kSecond = 1'000'000;

// Some chunks long, of its own kind for each seed.
Bytes block_of(std::uint64_t seed, int rectangles = 200) {
  tests::Random random(seed);
  ReferenceBlock block{.extent = tests::box_around({0, 0}, 20'000)};
  block.accuracy_mm = static_cast<std::uint32_t>(random.between(100, 900));
  for (int i = 0; i < rectangles; ++i) {
    const Kind kind = random.one_in(2) ? Kind::kBuilding : Kind::kRoad;
    const PointCm low{random.between(-20'000, 17'000), random.between(-20'000, 17'000)};
    const PointCm high{low.x + random.between(1, 3'000), low.y + random.between(1, 3'000)};
    block.features.push_back({kind, {tests::rectangle({low, high})}});
  }
  return block.bytes();
}

struct Bench {
  static std::size_t chunks(const Bytes& block) { return (block.size() + 1'279) / 1'280; }

  // The chunk of a number as docs/spec.md has it.
  Fate send(const Bytes& block, std::size_t number, std::uint32_t from = kSender) {
    const auto all = std::as_bytes(std::span(block));
    const std::size_t offset = number * 1'280;
    const tests::ChunkBytes message(
        crc_of(block), static_cast<std::uint32_t>(all.size()), static_cast<std::uint32_t>(offset),
        all.subspan(offset, std::min<std::size_t>(1'280, all.size() - offset)));
    ++datagrams;
    return delivery->receive(from, message.bytes(), now_us);
  }
  void send_all(const Bytes& block) {
    for (std::size_t i = 0; i < chunks(block); ++i) {
      send(block, i);
    }
  }
  // As many frames as the check may take.
  void settle() {
    for (int frame = 0; frame < 100; ++frame) {
      delivery->work();
    }
  }
  // What the block in use says of itself, 0 if there is none.
  [[nodiscard]] std::uint32_t in_use(std::uint32_t (Block::*words)() const) const {
    const Block* const block = delivery->in_use();
    return block == nullptr ? 0 : (block->*words)();
  }
  [[nodiscard]] std::uint32_t crc_in_use() const { return in_use(&Block::crc); }
  [[nodiscard]] std::uint32_t count(Fate fate) const {
    return delivery->report().fates.at(static_cast<std::size_t>(fate));
  }

  std::unique_ptr<Delivery> delivery =
      std::make_unique<Delivery>(SourceDescription{.source_ipv4 = kSender}, kPeer);
  std::uint64_t now_us = 5 * kSecond;
  std::uint32_t datagrams = 0;
};

TEST(MapDelivery, ListensToItsPortAndItsSenderOrTheReplayer) {
  Bench bench;
  const Bytes block = block_of(1);
  EXPECT_TRUE(bench.delivery->listens_to(15'011));
  EXPECT_FALSE(bench.delivery->listens_to(15'010));
  EXPECT_EQ(bench.send(block, 0, kSender + 1), Fate::kStranger);
  EXPECT_EQ(bench.send(block, 0, 0), Fate::kStranger);
  EXPECT_EQ(bench.send(block, 0, kPeer), Fate::kTaken);
  EXPECT_EQ(bench.send(block, 1), Fate::kTaken);
}

TEST(MapDelivery, ABlockIsInUseWhenAllOfItHasComeAndIsChecked) {
  Bench bench;
  const Bytes block = block_of(1);
  ASSERT_GT(Bench::chunks(block), 10U);
  for (std::size_t i = 0; i + 1 < Bench::chunks(block); ++i) {
    ASSERT_EQ(bench.send(block, i), Fate::kTaken);
    bench.delivery->work();
    ASSERT_EQ(bench.delivery->in_use(), nullptr);
    ASSERT_EQ(bench.delivery->report().chunks_there, i + 1);
    ASSERT_EQ(bench.delivery->report().state, DeliveryState::kReceiving);
  }
  bench.send(block, Bench::chunks(block) - 1);
  EXPECT_EQ(bench.delivery->report().state, DeliveryState::kChecking);
  EXPECT_EQ(bench.delivery->in_use(), nullptr) << "only from a frame on";
  bench.settle();
  EXPECT_EQ(bench.crc_in_use(), crc_of(block));
  EXPECT_EQ(bench.in_use(&Block::feature_count), 200U);
  EXPECT_EQ(bench.delivery->report().state, DeliveryState::kIdle);
  EXPECT_EQ(bench.send(block, 0), Fate::kInUse);
}

// In any order, with any loss and repetition: what is missing is asked of the next round alone.
TEST(MapDelivery, NeitherOrderNorLossNorRepetitionShows) {
  tests::Random random(3);
  for (int round = 0; round < 50; ++round) {
    Bench bench;
    const Bytes block = block_of(static_cast<std::uint64_t>(round), 60);
    std::vector<std::size_t> left(Bench::chunks(block));
    std::iota(left.begin(), left.end(), std::size_t{0});
    std::vector<std::size_t> there;
    while (!left.empty()) {
      bench.now_us += static_cast<std::uint64_t>(random.between(0, 3'000'000));
      if (!there.empty() && random.one_in(3)) {
        ASSERT_EQ(bench.send(block, there[random.below(there.size())]), Fate::kRepeated);
      }
      const std::size_t next = random.below(left.size());
      ASSERT_EQ(bench.send(block, left[next]), Fate::kTaken);
      there.push_back(left[next]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
      ASSERT_EQ(bench.crc_in_use(), 0U);
      bench.delivery->work();
    }
    bench.settle();
    ASSERT_EQ(bench.crc_in_use(), crc_of(block));
  }
}

TEST(MapDelivery, AnotherBlockWaitsUntilThePresentOneHasStopped) {
  Bench bench;
  const Bytes first = block_of(1);
  const Bytes second = block_of(2);
  bench.send(first, 0);
  bench.now_us += kSecond - 1;
  EXPECT_EQ(bench.send(second, 0), Fate::kOtherBlock);
  EXPECT_EQ(bench.send(first, 0), Fate::kRepeated) << "nothing new, so its second goes on";
  bench.now_us += 1;
  EXPECT_EQ(bench.send(second, 0), Fate::kTaken);
  EXPECT_EQ(bench.send(first, 1), Fate::kOtherBlock);
  EXPECT_EQ(bench.delivery->report().chunks_there, 1U);
}

// Two senders at once: the one that began is in use first, then the other; none is stopped.
TEST(MapDelivery, TwoBlocksInterleaved) {
  Bench bench;
  const Bytes first = block_of(1);
  const Bytes second = block_of(2);
  for (std::size_t i = 0; i < Bench::chunks(first); ++i) {
    EXPECT_EQ(bench.send(first, i), Fate::kTaken);
    EXPECT_EQ(bench.send(second, i % Bench::chunks(second)), Fate::kOtherBlock);
    bench.now_us += 1'000;
  }
  EXPECT_EQ(bench.send(second, 0), Fate::kOtherBlock) << "also while the first is checked";
  bench.settle();
  EXPECT_EQ(bench.crc_in_use(), crc_of(first));
  bench.send_all(second);
  bench.settle();
  EXPECT_EQ(bench.crc_in_use(), crc_of(second));
}

// The same CRC, and another length: that is another block, which a forger can say.
TEST(MapDelivery, ABlockIsNamedByItsLengthToo) {
  Bench bench;
  const Bytes block = block_of(1);
  bench.send(block, 0);
  const tests::ChunkBytes forged(crc_of(block), 10, 0, std::vector<std::byte>(10));
  EXPECT_EQ(bench.delivery->receive(kSender, forged.bytes(), bench.now_us), Fate::kOtherBlock);
  bench.send_all(block);
  bench.settle();
  EXPECT_EQ(bench.crc_in_use(), crc_of(block));
}

TEST(MapDelivery, ADamagedBlockIsRefusedWholeAndTheOldOneStays) {
  Bench bench;
  const Bytes old = block_of(1);
  bench.send_all(old);
  bench.settle();
  Bytes damaged = block_of(2);
  damaged.back() ^= 1;
  bench.send_all(damaged);
  bench.settle();
  EXPECT_EQ(bench.crc_in_use(), crc_of(old));
  EXPECT_EQ(bench.in_use(&Block::feature_count), 200U);
  EXPECT_EQ(bench.delivery->report().blocks_refused, 1U);
  EXPECT_EQ(bench.delivery->report().last_refusal, Refusal::kDamaged);
  EXPECT_EQ(bench.delivery->report().state, DeliveryState::kIdle);
  // Once more, and sound: nothing of the first time is left.
  const Bytes sound = block_of(2);
  bench.send_all(sound);
  bench.settle();
  EXPECT_EQ(bench.crc_in_use(), crc_of(sound));
}

TEST(MapDelivery, AnyOtherRefusalHasItsNameToo) {
  Bench bench;
  Bytes wrong = block_of(1);
  tests::put(wrong, 6, 3, 1);  // no such source
  wrong = sealed(wrong);
  bench.send_all(wrong);
  bench.settle();
  EXPECT_EQ(bench.delivery->in_use(), nullptr);
  EXPECT_EQ(bench.delivery->report().last_refusal, Refusal::kWrongSource);
}

// A sound block under a wrong name would be taken for another one at each of its chunks.
TEST(MapDelivery, ABlockThatIsNotTheOneItsChunksNameIsRefused) {
  Bench bench;
  const Bytes bytes = ReferenceBlock{}.bytes();
  const auto piece = std::as_bytes(std::span(bytes));
  ASSERT_LE(piece.size(), 1'280U);
  const tests::ChunkBytes message(1, static_cast<std::uint32_t>(piece.size()), 0, piece);
  EXPECT_EQ(bench.delivery->receive(kSender, message.bytes(), bench.now_us), Fate::kTaken);
  bench.settle();
  EXPECT_EQ(bench.delivery->in_use(), nullptr);
  EXPECT_EQ(bench.delivery->report().last_refusal, Refusal::kDamaged);
}

TEST(MapDelivery, ABlockThatWasThereAtTheStartGivesWay) {
  Bench bench;
  const Bytes baked = block_of(1);
  bench.delivery->begin_with(baked);
  EXPECT_EQ(bench.crc_in_use(), crc_of(baked));
  EXPECT_EQ(bench.send(baked, 0), Fate::kInUse);
  for (const std::uint64_t seed : {2U, 3U, 4U}) {
    const Bytes next = block_of(seed);
    bench.send_all(next);
    EXPECT_NE(bench.crc_in_use(), crc_of(next));
    bench.settle();
    EXPECT_EQ(bench.crc_in_use(), crc_of(next));
    // What is in use is not what the next one is written over.
    EXPECT_EQ(check(std::span(next)), Refusal::kNone);
    EXPECT_EQ(bench.in_use(&Block::accuracy_mm), block_of(seed)[54] * 256U + block_of(seed)[55]);
  }
}

TEST(MapDelivery, ADamagedBlockAtTheStartIsCounted) {
  Bench bench;
  Bytes damaged = block_of(1);
  damaged[100] ^= 1;
  bench.delivery->begin_with(damaged);
  EXPECT_EQ(bench.delivery->in_use(), nullptr);
  EXPECT_EQ(bench.delivery->report().blocks_refused, 1U);
  EXPECT_EQ(bench.delivery->report().last_refusal, Refusal::kDamaged);
}

// The longest block there can be: its frames are counted, and none of its bytes is lost.
TEST(MapDelivery, TheLongestBlockIsCheckedPieceByPiece) {
  Bench bench;
  // Each rectangle is 52 bytes and four for each bucket it meets.
  ReferenceBlock plan{.extent = tests::box_around({0, 0}, 200'000)};
  for (std::int32_t i = 0; i < 70'000; ++i) {
    const PointCm low{-200'000 + i % 390 * 1'000, -200'000 + i / 390 * 1'000};
    plan.features.push_back({Kind::kBuilding, {tests::rectangle({low, {low.x + 1, low.y + 1}})}});
  }
  const Bytes block = plan.bytes();
  ASSERT_GT(block.size(), 3'900'000U);
  ASSERT_LE(block.size(), kMaxBlockBytes);
  bench.send_all(block);
  int frames = 0;
  while (bench.delivery->in_use() == nullptr && frames < 1'000) {
    bench.delivery->work();
    ++frames;
  }
  EXPECT_EQ(bench.crc_in_use(), crc_of(block));
  EXPECT_GE(frames, 30);   // twice its length, in pieces
  EXPECT_LE(frames, 100);  // 4 s at 25 frames a second
}

// However it is cut, a check says the same.
TEST(MapDelivery, PiecesOfACheckAreTheWholeOne) {
  tests::Random random(5);
  for (int round = 0; round < 300; ++round) {
    Bytes block = block_of(static_cast<std::uint64_t>(round), 40);
    for (int damage = random.between(0, 2); damage > 0; --damage) {
      block[random.below(block.size())] = static_cast<std::uint8_t>(random.below(256));
      block = sealed(block);
    }
    Check pieces(block);
    const std::size_t budget = 1 + random.below(400);
    while (!pieces.advance(budget)) {
    }
    EXPECT_EQ(pieces.verdict(), check(block));
  }
}

// Whatever comes: each datagram has one fate, and only whole sound blocks come into use.
TEST(MapDelivery, AnyMixtureOfBlocksAndDamage) {
  tests::Random random(7);
  const std::vector<Bytes> blocks{block_of(1, 50), block_of(2, 80), block_of(3, 20)};
  Bench bench;
  std::uint32_t changes = 0;
  std::uint32_t before = 0;
  for (int i = 0; i < 20'000; ++i) {
    bench.now_us += static_cast<std::uint64_t>(random.between(0, 400'000));
    const Bytes& block = blocks[random.below(3)];
    if (random.one_in(4)) {
      std::vector<std::byte> noise(random.below(200));
      std::ranges::generate(noise, [&] { return static_cast<std::byte>(random.next()); });
      ++bench.datagrams;
      EXPECT_NE(bench.delivery->receive(kSender, noise, bench.now_us), Fate::kTaken);
    } else {
      bench.send(block, random.below(Bench::chunks(block)));
    }
    if (random.one_in(5)) {
      bench.delivery->work();
    }
    const std::uint32_t now = bench.crc_in_use();
    changes += now != before ? 1U : 0U;
    before = now;
    ASSERT_TRUE(now == 0 ||
                std::ranges::any_of(blocks, [&](const Bytes& one) { return crc_of(one) == now; }));
  }
  const auto& fates = bench.delivery->report().fates;
  EXPECT_EQ(std::accumulate(fates.begin(), fates.end(), 0U), bench.datagrams);
  EXPECT_EQ(bench.delivery->report().blocks_refused, 0U);
  EXPECT_GT(changes, 3U);
}

}  // namespace
}  // namespace iog::map
