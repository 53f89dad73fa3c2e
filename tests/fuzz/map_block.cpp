// The check of a map block (map/block.hpp), and what reads a block that has passed. The input is a
// block, made to say its own length and CRC so that the checks behind these are reached.
// Laws: a check in pieces comes to the same verdict; of what has passed, every feature is found
// once by the box of all, and by its own box; its edges close, and stay within its box.
#include <algorithm>
#include <vector>

#include "checksum/crc32.hpp"
#include "law.hpp"
#include "map/block.hpp"

namespace iog::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put(Bytes& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
  }
}

void seal(Bytes& bytes) {
  if (bytes.size() < map::kHeaderBytes) {
    return;
  }
  put(bytes, 8, static_cast<std::uint32_t>(bytes.size()));
  const auto all = std::as_bytes(std::span(bytes));
  checksum::Crc32 crc;
  crc.update(all.first(12));
  crc.update(all.subspan(16));
  put(bytes, 12, crc.value());
}

void check_feature(const map::Feature& feature) {
  const map::BoxCm box = feature.box();
  std::uint32_t edges = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
  feature.for_each_edge([&](map::PointCm from, map::PointCm to) {
    ++edges;
    law(box.holds(from) && box.holds(to), "a feature is in its box");
    x += std::int64_t{to.x} - from.x;
    y += std::int64_t{to.y} - from.y;
  });
  law(edges == feature.edge_count(), "a feature has as many edges as it says");
  law(x == 0 && y == 0, "rings are closed");
}

void check_block(const map::Block& block) {
  std::uint32_t found = 0;
  block.for_each_feature_in(block.extent(), [&](const map::Feature& feature) {
    ++found;
    check_feature(feature);
  });
  law(found == block.feature_count(), "each feature is found once");
  for (std::uint32_t number = 0; number < std::min(block.feature_count(), 50U); ++number) {
    const map::BoxCm box = block.feature(number).box();
    std::uint32_t same = 0;
    std::uint32_t alike = 0;
    block.for_each_feature_in(
        box, [&](const map::Feature& other) { same += other.box() == box ? 1U : 0U; });
    for (std::uint32_t other = 0; other < block.feature_count(); ++other) {
      alike += block.feature(other).box() == box ? 1U : 0U;
    }
    law(same == alike, "a feature is found by its own box");
  }
  law(!block.attribution().empty(), "a map says whose it is");
}

}  // namespace

void check(std::span<const std::byte> input) {
  wire::ByteReader in(input);
  const bool is_sealed = in.u8() % 8 != 0;
  const std::size_t budget = in.u8() * std::size_t{16} + 1;
  const auto rest = in.bytes(in.remaining());
  Bytes bytes(rest.size());
  std::ranges::transform(rest, bytes.begin(),
                         [](std::byte byte) { return std::to_integer<std::uint8_t>(byte); });
  if (is_sealed) {
    seal(bytes);
  }
  const map::Refusal refusal = map::check(bytes);
  map::Check pieces(bytes);
  while (!pieces.advance(budget)) {
  }
  law(pieces.verdict() == refusal, "a check in pieces is the same");
  if (refusal == map::Refusal::kNone) {
    check_block(map::Block(bytes));
  }
}

}  // namespace iog::fuzz
