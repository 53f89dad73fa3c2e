#include "tools/frames/tile_decoding.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "tile_coding/bit_stream.hpp"
#include "tile_coding/symbol_packing.hpp"

namespace iog::tile_coding {
namespace {

constexpr std::size_t kAgeBytes = 1;

bool decode_raw(std::span<const std::byte> payload, MutableTileCells cells) {
  if (payload.size() != kTileBytes ||
      std::memchr(payload.data(), std::to_integer<int>(kNoIndex), kTileBytes) != nullptr) {
    return false;
  }
  std::ranges::copy(payload, cells.begin());
  return true;
}

// Takes them from the front of the payload: u8 how many, then each, int8. Nothing if it is too
// short, they are too many, or one is no index.
std::optional<std::span<const std::byte>> take_values(std::span<const std::byte>& payload) {
  const std::size_t count = payload.empty() ? 0 : std::to_integer<std::size_t>(payload[0]);
  if (payload.size() < 1 + count || count > kMostAlternatives) {
    return std::nullopt;
  }
  const auto values = payload.subspan(1, count);
  payload = payload.subspan(1 + count);
  return std::ranges::find(values, kNoIndex) == values.end() ? std::optional(values) : std::nullopt;
}

// Where runs start, bit x of word y, and how many they are.
struct Starts {
  std::array<std::uint32_t, kTileSide> rows{};
  std::size_t count = 0;
};

// Takes them from the front of the payload. False if it is too short, or a block that is said to
// have a start has none.
bool take_starts(std::span<const std::byte>& payload, Starts& starts) {
  if (payload.size() < TileRuns::kSets) {
    return false;
  }
  const auto sets = payload.first<TileRuns::kSets>();
  payload = payload.subspan(sets.size());
  for (std::size_t block = 0; block < TileRuns::kBlocks; ++block) {
    if ((std::to_integer<unsigned>(sets[block / 8]) >> (block % 8) & 1U) == 0) {
      continue;
    }
    if (payload.empty() || payload[0] == std::byte{0}) {
      return false;
    }
    const auto cells = std::to_integer<std::uint32_t>(payload[0]);
    payload = payload.subspan(1);
    const std::size_t y = block / TileRuns::kBlocksPerRow * 2;
    const std::size_t x = block % TileRuns::kBlocksPerRow * 4;
    starts.rows[y] |= (cells & 0xFU) << x;
    starts.rows[y + 1] |= (cells >> 4) << x;
    starts.count += static_cast<std::size_t>(std::popcount(cells));
  }
  return true;
}

using Digits = std::array<std::uint8_t, kTileBytes>;

// Reads so many symbols; false if they are not what was packed.
bool read_digits(BitReader& in, std::uint32_t alternatives, std::size_t count, Digits& digits) {
  const Packing packing = kPackings[alternatives];
  if (packing.bits == 0) {
    return true;
  }
  std::size_t fours = (count + 3) / 4;
  for (std::size_t first = 0; fours > 0;) {
    const std::size_t in_number = std::min<std::size_t>(packing.fours, fours);
    const bool is_whole = in_number == packing.fours;
    std::uint32_t number = in.bits(is_whole ? packing.bits : packing.rest_bits(in_number));
    for (std::size_t i = 4 * in_number; i > 0; --i, number /= alternatives) {
      const auto digit = static_cast<std::uint8_t>(number % alternatives);
      if (first + i - 1 < count) {
        digits[first + i - 1] = digit;
      } else if (digit != 0) {
        return false;
      }
    }
    if (number != 0) {
      return false;
    }
    first += 4 * in_number;
    fours -= in_number;
  }
  return true;
}

// The runs, from the first cell on. Symbol 0 stands for the reference's cells, and the values count
// from 1. The tile begins as in the reference, and no run has the symbol of the run before it.
void draw_runs(const Starts& starts, const Digits& digits, std::span<const std::byte> values,
               const std::optional<TileCells>& reference, MutableTileCells cells) {
  std::size_t symbol = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < kTileBytes; ++i) {
    if ((starts.rows[i / kTileSide] >> (i % kTileSide) & 1U) != 0) {
      const std::size_t digit = digits[next++];
      symbol = digit + (digit >= symbol ? 1 : 0);
    }
    const std::byte as_reference = reference ? (*reference)[i] : std::byte{0};
    cells[i] = symbol == 0 ? as_reference : values[symbol - 1];
  }
}

bool decode_run_starts(std::span<const std::byte> payload,
                       const std::optional<TileCells>& reference, MutableTileCells cells) {
  const auto values = take_values(payload);
  if (!values) {
    return false;
  }
  Starts starts;
  Digits digits{};
  if (values->empty()) {
    draw_runs(starts, digits, {}, reference, cells);
    return payload.empty();
  }
  if (!take_starts(payload, starts)) {
    return false;
  }
  BitReader in(payload);
  const auto alternatives = static_cast<std::uint32_t>(values->size());
  if (!read_digits(in, alternatives, starts.count, digits) || !in.ends_here()) {
    return false;
  }
  draw_runs(starts, digits, *values, reference, cells);
  return true;
}

}  // namespace

std::optional<std::uint32_t> reference_frame(Encoding encoding, std::span<const std::byte> payload,
                                             std::uint32_t frame_number) {
  if (encoding == Encoding::kRunStartsSince && payload.size() >= kAgeBytes) {
    return frame_number - std::to_integer<std::uint32_t>(payload[0]);
  }
  return std::nullopt;
}

DecodeStatus decode(Encoding encoding, std::span<const std::byte> payload,
                    std::uint32_t frame_number, const std::optional<Reference>& reference,
                    MutableTileCells cells) {
  bool is_tile = false;
  switch (encoding) {
    case Encoding::kRaw:
      is_tile = decode_raw(payload, cells);
      break;
    case Encoding::kRunStarts:
      is_tile = decode_run_starts(payload, std::nullopt, cells);
      break;
    case Encoding::kRunStartsSince: {
      const std::optional<std::uint32_t> frame = reference_frame(encoding, payload, frame_number);
      if (frame && (!reference || reference->frame_number != *frame)) {
        return DecodeStatus::kUnknownReference;
      }
      is_tile = frame && decode_run_starts(payload.subspan(kAgeBytes), reference->cells, cells);
      break;
    }
    default:
      return DecodeStatus::kUnknownEncoding;
  }
  return is_tile ? DecodeStatus::kOk : DecodeStatus::kMalformed;
}

}  // namespace iog::tile_coding
