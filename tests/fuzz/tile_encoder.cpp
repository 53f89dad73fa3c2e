// Every tile comes back, with a reference and without one. The input is the tile, as rectangles on
// a flat ground, and what has changed since the reference.
#include <algorithm>
#include <array>

#include "law.hpp"
#include "tile_coding/encode.hpp"
#include "tools/frames/tile_decoding.hpp"

namespace iog::fuzz {
namespace {

using tile_coding::kTileBytes;
using tile_coding::kTileSide;
using tile_coding::Reference;
using Tile = std::array<std::byte, kTileBytes>;

std::byte index_of(std::uint8_t value) {
  const auto byte = static_cast<std::byte>(value);
  return byte == tile_coding::kNoIndex ? std::byte{0} : byte;
}

void draw(wire::ByteReader& in, Tile& tile) {
  const std::size_t x = in.u8() % kTileSide;
  const std::size_t y = in.u8() % kTileSide;
  const std::uint8_t size = in.u8();
  const std::byte value = index_of(in.u8());
  const std::size_t width = std::min<std::size_t>(size % 16 + 1, kTileSide - x);
  const std::size_t height = std::min<std::size_t>(size / 16 + 1, kTileSide - y);
  for (std::size_t i = 0; i < width * height; ++i) {
    tile.at((y + i / width) * kTileSide + x + i % width) = value;
  }
}

void check_encoding(const Tile& tile, const std::optional<Reference>& reference) {
  constexpr std::uint32_t kFrame = 0x01020306;
  static tile_coding::Encoder encoder;
  Tile payload{};
  const tile_coding::EncodedTile result = encoder.encode(tile, kFrame, reference, payload);
  law(result.bytes <= kTileBytes, "no payload is longer than raw");
  Tile decoded{};
  law(tile_coding::decode(result.encoding, std::span(payload).first(result.bytes), kFrame,
                          reference, decoded) == tile_coding::DecodeStatus::kOk,
      "it is accepted");
  law(decoded == tile, "and is the tile");
}

}  // namespace

void check(std::span<const std::byte> input) {
  wire::ByteReader in(input);
  Tile before;
  before.fill(index_of(in.u8()));
  for (std::size_t count = in.u8() % 32U; count > 0; --count) {
    draw(in, before);
  }
  Tile tile = before;
  while (in.remaining() > 0) {
    draw(in, tile);
  }
  check_encoding(tile, std::nullopt);
  check_encoding(tile, Reference{.cells = before, .frame_number = 0x01020304});
}

}  // namespace iog::fuzz
