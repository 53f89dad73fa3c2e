// The decoder of tiles: an encoding, the numbers of two frames, then a payload for it.
#include <algorithm>
#include <array>

#include "iogrid_tiles.h"
#include "law.hpp"
#include "tile_coding/encode.hpp"
#include "tools/frames/tile_decoding.hpp"

namespace iog::fuzz {
namespace {

using tile_coding::decode;
using tile_coding::DecodeStatus;
using tile_coding::Encoding;
using tile_coding::kTileBytes;
using tile_coding::Reference;
using Tile = std::array<std::byte, kTileBytes>;

// What the receiver has: anything that is not flat.
Tile reference_cells() {
  Tile tile{};
  for (std::size_t i = 0; i < tile.size(); ++i) {
    tile[i] = static_cast<std::byte>(i / 7 % 5 + i / 100);
  }
  return tile;
}

// Whether clients/c reads the payload likewise.
bool is_as_client_reads(Encoding encoding, std::span<const std::byte> payload,
                        std::uint32_t frame_number, const Reference& reference, DecodeStatus status,
                        const Tile& cells) {
  const auto number = static_cast<std::uint32_t>(encoding);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(payload.data());
  const bool stands_alone = number != 5;
  std::array<std::uint8_t, kTileBytes> own{};
  std::ranges::transform(reference.cells, own.begin(), std::to_integer<std::uint8_t>);
  std::array<std::uint8_t, kTileBytes> clients{};
  const bool is_tile =
      (stands_alone ||
       iogrid_reference(number, bytes, payload.size(), frame_number) == reference.frame_number) &&
      iogrid_tile(number, bytes, payload.size(), own.data(), clients.data()) != 0 &&
      std::ranges::find(clients, std::uint8_t{0x80}) == clients.end();
  return is_tile == (status == DecodeStatus::kOk) &&
         (!is_tile || std::ranges::equal(std::as_bytes(std::span(clients)), cells));
}

}  // namespace

void check(std::span<const std::byte> input) {
  static const Tile receivers_tile = reference_cells();
  static tile_coding::Encoder encoder;
  wire::ByteReader in(input);
  const auto encoding = static_cast<Encoding>(in.u8());
  const std::uint32_t frame_number = in.u8();
  const Reference reference{.cells = receivers_tile, .frame_number = in.u8()};
  const auto payload = in.bytes(in.remaining());
  Tile cells;
  cells.fill(std::byte{1});
  Tile others;
  others.fill(std::byte{2});
  const DecodeStatus status = decode(encoding, payload, frame_number, reference, cells);
  law(decode(encoding, payload, frame_number, reference, others) == status,
      "the outcome is the payload's");
  law(is_as_client_reads(encoding, payload, frame_number, reference, status, cells),
      "the reader in C decodes likewise");
  if (status != DecodeStatus::kOk) {
    return;
  }
  law(cells == others, "every cell is the payload's");
  law(std::ranges::find(cells, tile_coding::kNoIndex) == cells.end(), "every cell is an index");
  Tile again{};
  const tile_coding::EncodedTile encoded =
      encoder.encode(cells, reference.frame_number + 1, reference, again);
  law(encoded.bytes <= kTileBytes, "no code is longer than a raw tile");
  law(decode(encoded.encoding, std::span(again).first(encoded.bytes), reference.frame_number + 1,
             reference, others) == DecodeStatus::kOk &&
          cells == others,
      "what was accepted can be encoded");
}

}  // namespace iog::fuzz
