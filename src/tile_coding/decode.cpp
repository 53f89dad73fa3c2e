// Each decoder ends, because a run or a block has at least one cell and is refused if it does not
// fit.
#include "tile_coding/decode.hpp"

#include <algorithm>
#include <bit>

#include "tile_coding/bit_stream.hpp"
#include "wire/byte_order.hpp"

namespace iog::tile_coding {
namespace {

constexpr unsigned kMaxLengthBits = kTileSideLog2 * 2;  // behind the highest of a length

// Reads Elias' gamma code; 0 if it is not the code of a length.
std::size_t read_length(BitReader& in) {
  unsigned zeros = 0;
  while (!in.bit()) {
    if (++zeros > kMaxLengthBits) {
      return 0;
    }
  }
  return (std::size_t{1} << zeros) | in.bits(zeros);
}

// Takes the list of values from the front of the payload; empty if it is malformed.
struct Values {
  std::span<const std::byte> list;
  std::span<const std::byte> rest;
  bool ok = false;
};

Values take_values(std::span<const std::byte> payload) {
  if (payload.empty()) {
    return {};
  }
  const auto count = std::to_integer<std::size_t>(payload[0]);
  if (payload.size() < 1 + count) {
    return {};
  }
  const auto list = payload.subspan(1, count);
  return {.list = list,
          .rest = payload.subspan(1 + count),
          .ok = std::ranges::find(list, kNoIndex) == list.end()};
}

// With a reference, symbol 0 stands for the reference's cells, and the values count from 1.
bool decode_runs(std::span<const std::byte> payload, const Reference* reference,
                 MutableTileCells cells) {
  const Values values = take_values(payload);
  const std::size_t first_value = reference != nullptr ? 1 : 0;
  const std::size_t symbols = values.list.size() + first_value;
  if (!values.ok || symbols == 0) {
    return false;
  }
  BitReader in(values.rest);
  unsigned bits = symbol_bits(symbols);
  std::size_t before = symbols;  // above every symbol: nothing is excluded
  for (std::size_t begin = 0; begin < kTileBytes;) {
    const std::size_t code = in.bits(bits);
    const std::size_t symbol = code + (code >= before ? 1 : 0);
    const std::size_t length = read_length(in);
    if (!in.ok() || symbol >= symbols || length == 0 || length > kTileBytes - begin) {
      return false;
    }
    const auto run = cells.subspan(begin, length);
    if (symbol < first_value) {
      std::ranges::copy(reference->cells.subspan(begin, length), run.begin());
    } else {
      std::ranges::fill(run, values.list[symbol - first_value]);
    }
    before = symbol;
    bits = symbol_bits(symbols - 1);
    begin += length;
  }
  return in.ends_here();
}

void fill_block(MutableTileCells cells, std::size_t m, std::size_t level, std::byte value) {
  const std::size_t corner = cell_of_morton(m);
  const std::size_t side = std::size_t{1} << level;
  for (std::size_t y = 0; y < side; ++y) {
    std::ranges::fill(cells.subspan(corner + y * kTileSide, side), value);
  }
}

bool decode_quadtree(std::span<const std::byte> payload, MutableTileCells cells) {
  const Values values = take_values(payload);
  if (!values.ok || values.list.empty()) {
    return false;
  }
  BitReader in(values.rest);
  const unsigned bits = symbol_bits(values.list.size());
  for (std::size_t m = 0; m < kTileBytes;) {
    std::size_t level =
        m == 0 ? Quadtree::kLevels : static_cast<std::size_t>(std::countr_zero(m)) / 2;
    while (level > 0 && in.bit()) {
      --level;
    }
    const std::size_t symbol = in.bits(bits);
    if (!in.ok() || symbol >= values.list.size()) {
      return false;
    }
    fill_block(cells, m, level, values.list[symbol]);
    m += std::size_t{1} << (2 * level);
  }
  return in.ends_here();
}

bool decode_raw(std::span<const std::byte> payload, MutableTileCells cells) {
  if (payload.size() != kTileBytes || std::ranges::find(payload, kNoIndex) != payload.end()) {
    return false;
  }
  std::ranges::copy(payload, cells.begin());
  return true;
}

DecodeStatus decode_since(std::span<const std::byte> payload,
                          const std::optional<Reference>& reference, MutableTileCells cells) {
  const std::optional<std::uint32_t> frame = reference_frame(payload);
  if (!frame) {
    return DecodeStatus::kMalformed;
  }
  if (!reference || reference->frame_number != *frame) {
    return DecodeStatus::kUnknownReference;
  }
  return decode_runs(payload.subspan(4), &*reference, cells) ? DecodeStatus::kOk
                                                             : DecodeStatus::kMalformed;
}

}  // namespace

std::optional<std::uint32_t> reference_frame(std::span<const std::byte> payload) {
  if (payload.size() < 4) {
    return std::nullopt;
  }
  return wire::load_be32(payload.first<4>());
}

DecodeStatus decode(Encoding encoding, std::span<const std::byte> payload,
                    const std::optional<Reference>& reference, MutableTileCells cells) {
  bool is_tile = false;
  switch (encoding) {
    case Encoding::kRaw:
      is_tile = decode_raw(payload, cells);
      break;
    case Encoding::kRunLength:
      is_tile = decode_runs(payload, nullptr, cells);
      break;
    case Encoding::kQuadtree:
      is_tile = decode_quadtree(payload, cells);
      break;
    case Encoding::kChangedSince:
      return decode_since(payload, reference, cells);
    default:
      return DecodeStatus::kUnknownEncoding;
  }
  return is_tile ? DecodeStatus::kOk : DecodeStatus::kMalformed;
}

}  // namespace iog::tile_coding
