// What a block tells. Blocks come from fakes/reference_block.hpp, which writes them by
// docs/spec.md.
#include "map/block.hpp"

#include <random>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/reference_block.hpp"

namespace iog::map {
namespace {

using tests::ReferenceBlock;
using tests::ReferenceFeature;

ReferenceFeature house(const BoxCm& box) { return {Kind::kBuilding, {tests::rectangle(box)}}; }

// Houses and roads of all sizes, some over many buckets.
ReferenceBlock town(std::uint32_t seed, int count) {
  std::mt19937 random(seed);
  ReferenceBlock block{.extent = {{-12'345, -7'000}, {9'876, 11'111}}};
  const auto between = [&](std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(high - low + 1));
  };
  for (int i = 0; i < count; ++i) {
    const PointCm low{between(block.extent.low.x, block.extent.high.x - 1),
                      between(block.extent.low.y, block.extent.high.y - 1)};
    const std::int32_t size = i % 8 == 0 ? 30'000 : 1'500;
    const PointCm high{between(low.x + 1, std::min(low.x + size, block.extent.high.x)),
                       between(low.y + 1, std::min(low.y + size, block.extent.high.y))};
    block.features.push_back(house({low, high}));
    block.features.back().kind = i % 2 == 0 ? Kind::kBuilding : Kind::kRoad;
  }
  return block;
}

std::vector<BoxCm> visited(const Block& block, const BoxCm& box) {
  std::vector<BoxCm> boxes;
  block.for_each_feature_in(box, [&](const Feature& feature) { boxes.push_back(feature.box()); });
  return boxes;
}

// By Python, from h = 0xcbf29ce484222325:
// for b in struct.pack(">qq", latitude, longitude): h = (h ^ b) * 0x100000001b3 % 2**64
TEST(MapOrigin, HasTheNameThatFnvGives) {
  EXPECT_EQ(origin_name(49'012'345'678, -8'765'432'109), 0xD7E02162F2852409U);
  EXPECT_EQ(origin_name(0, 0), 0x88201FB960FF6465U);
  EXPECT_EQ(origin_name(1, 0), 0xF4B5CA5BCC646E52U);
}

TEST(MapBlock, TellsWhatItsHeaderSays) {
  const ReferenceBlock written{.features = {house({{0, 0}, {100, 200}})}};
  const auto bytes = written.bytes();
  ASSERT_EQ(check(bytes), Refusal::kNone);
  const Block block(bytes);
  EXPECT_EQ(block.latitude(), written.latitude);
  EXPECT_EQ(block.longitude(), written.longitude);
  EXPECT_EQ(block.extent(), written.extent);
  EXPECT_EQ(block.source(), Source::kOpenStreetMap);
  EXPECT_EQ(block.belief(), 248);
  EXPECT_EQ(block.date_s(), 1'700'000'000U);
  EXPECT_EQ(block.accuracy_mm(), 500U);
  EXPECT_EQ(block.attribution(), "A town");
  EXPECT_EQ(block.size_bytes(), bytes.size());
  EXPECT_EQ(block.feature_count(), 1U);
  EXPECT_EQ(block.origin(), origin_name(written.latitude, written.longitude));
  EXPECT_EQ(block.crc(), tests::crc_of(bytes));
}

TEST(MapBlock, MayBeEmptyOfFeatures) {
  const auto bytes = ReferenceBlock{}.bytes();
  ASSERT_EQ(check(bytes), Refusal::kNone);
  EXPECT_TRUE(visited(Block(bytes), ReferenceBlock{}.extent).empty());
}

TEST(MapFeature, HasAllEdgesOfAllItsRings) {
  const std::vector<PointCm> outer{{-4'000, -3'000}, {3'000, -3'000}, {-500, 3'999}};
  const std::vector<PointCm> hole{{-600, 0}, {-500, 100}, {-400, 0}, {-500, -100}};
  const auto bytes = ReferenceBlock{.features = {{Kind::kRoad, {outer, hole}}}}.bytes();
  ASSERT_EQ(check(bytes), Refusal::kNone);
  const Feature feature = Block(bytes).feature(0);
  EXPECT_EQ(feature.kind(), Kind::kRoad);
  EXPECT_EQ(feature.ring_count(), 2U);
  EXPECT_EQ(feature.edge_count(), 7U);
  EXPECT_EQ(feature.box(), (BoxCm{{-4'000, -3'000}, {3'000, 3'999}}));
  std::vector<PointCm> ends;
  feature.for_each_edge([&](PointCm from, PointCm to) {
    ends.push_back(from);
    ends.push_back(to);
  });
  EXPECT_EQ(ends, (std::vector<PointCm>{outer[0], outer[1], outer[1], outer[2], outer[2], outer[0],
                                        hole[0], hole[1], hole[1], hole[2], hole[2], hole[3],
                                        hole[3], hole[0]}));
}

TEST(MapBlock, VisitsEachFeatureThatMeetsTheBoxOnce) {
  std::mt19937 random(7);
  const ReferenceBlock written = town(3, 200);
  const auto bytes = written.bytes();
  ASSERT_EQ(check(bytes), Refusal::kNone);
  const Block block(bytes);
  for (int i = 0; i < 300; ++i) {
    const auto coordinate = [&] { return static_cast<std::int32_t>(random() % 40'000) - 20'000; };
    const PointCm a{coordinate(), coordinate()};
    const PointCm b = i % 3 == 0 ? a : PointCm{coordinate(), coordinate()};
    const BoxCm asked{{std::min(a.x, b.x), std::min(a.y, b.y)},
                      {std::max(a.x, b.x), std::max(a.y, b.y)}};
    std::vector<BoxCm> met;
    for (const ReferenceFeature& feature : written.features) {
      const BoxCm box = feature.box();
      if (box.low.x <= asked.high.x && asked.low.x <= box.high.x && box.low.y <= asked.high.y &&
          asked.low.y <= box.high.y) {
        met.push_back(box);
      }
    }
    const auto boxes = visited(block, asked);
    EXPECT_TRUE(std::is_permutation(boxes.begin(), boxes.end(), met.begin(), met.end()))
        << boxes.size() << " visited, " << met.size() << " met";
    EXPECT_EQ(boxes, visited(block, asked)) << "the order is fixed";
  }
}

TEST(MapBlock, TakesAnyBox) {
  const auto bytes = town(4, 30).bytes();
  const Block block(bytes);
  EXPECT_EQ(visited(block, {{INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MAX}}).size(), 30U);
  EXPECT_TRUE(visited(block, {{INT32_MIN, INT32_MIN}, {INT32_MIN, INT32_MAX}}).empty());
  EXPECT_TRUE(visited(block, {{9'877, 0}, {INT32_MAX, 0}}).empty());
}

}  // namespace
}  // namespace iog::map
