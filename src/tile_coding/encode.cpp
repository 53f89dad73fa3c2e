#include "tile_coding/encode.hpp"

#include <algorithm>
#include <bit>

#include "tile_coding/bit_stream.hpp"
#include "tile_coding/digits.hpp"

namespace iog::tile_coding {
namespace {

EncodedTile raw(TileCells cells, MutableTileCells payload) {
  std::ranges::copy(cells, payload.begin());
  return {.encoding = Encoding::kRaw, .bytes = kTileBytes};
}

constexpr std::uint8_t kNoSymbol = 0;

// Non-zero if some byte is zero. The lowest set bit is then the top bit of the first zero byte.
std::uint32_t zero_bytes(std::uint32_t word) {
  return (word - 0x0101'0101U) & ~word & 0x8080'8080U;
}

}  // namespace

EncodedTile Encoder::encode(TileCells cells, std::uint32_t frame_number,
                            const std::optional<Reference>& reference, MutableTileCells payload) {
  const Encoding encoding = reference ? Encoding::kRunStartsSince : Encoding::kRunStarts;
  runs_.find(cells, reference ? std::optional(reference->cells) : std::nullopt);
  std::size_t bytes = 0;
  if (reference) {
    payload[bytes++] = static_cast<std::byte>(frame_number - reference->frame_number);
  }
  std::byte& count = payload[bytes++];
  const std::size_t values = number_values(payload.subspan(bytes).first<kMostAlternatives>());
  if (values > kMostAlternatives) {
    return raw(cells, payload);
  }
  count = static_cast<std::byte>(values);
  if (values == 0) {
    return {.encoding = encoding, .bytes = bytes};
  }
  bytes += values;
  bytes += runs_.write_starts(payload.subspan(bytes).first<TileRuns::kMostStartBytes>());
  if (bytes + most_symbol_bytes(values) >= kTileBytes) {
    return raw(cells, payload);
  }
  bytes += write_symbols(static_cast<std::uint32_t>(values), payload.subspan(bytes));
  return {.encoding = encoding, .bytes = bytes};
}

// Numbers the values of the runs in order of appearance and stores the symbols of all runs. The
// lowest symbol means "as in the reference". Returns the number of values. If that exceeds
// kMostAlternatives, the stored symbols are invalid.
std::size_t Encoder::number_values(std::span<std::byte, kMostAlternatives> values) {
  symbols_.fill(kNoSymbol);
  symbols_[runs_.as_reference()] = kLowestSymbol;
  const auto fours = runs_.fours();
  std::size_t count = 0;
  for (std::size_t i = 0; i < fours.size(); ++i) {
    std::uint32_t symbols = symbols_of(fours[i]);
    while (const std::uint32_t missing = zero_bytes(symbols)) {
      if (count == kMostAlternatives) {
        return count + 1;
      }
      const auto value = static_cast<std::uint8_t>(fours[i] >> (std::countr_zero(missing) - 7));
      values[count++] = std::byte{value};
      symbols_[value] = static_cast<std::uint8_t>(kLowestSymbol + count);
      symbols = symbols_of(fours[i]);
    }
    fours_[i] = symbols;
  }
  return count;
}

std::uint32_t Encoder::symbols_of(std::uint32_t four) const {
  return symbols_[four & 0xFFU] | std::uint32_t{symbols_[four >> 8 & 0xFFU]} << 8 |
         std::uint32_t{symbols_[four >> 16 & 0xFFU]} << 16 |
         std::uint32_t{symbols_[four >> 24]} << 24;
}

std::size_t Encoder::most_symbol_bytes(std::size_t alternatives) const {
  return (runs_.fours().size() * kPackings[alternatives].bits_of_four + 7) / 8;
}

std::size_t Encoder::write_symbols(std::uint32_t alternatives, std::span<std::byte> out) {
  const Packing packing = kPackings[alternatives];
  if (packing.bits == 0) {
    return 0;
  }
  const auto fours = std::span(fours_).first(runs_.fours().size());
  make_numbers(fours, alternatives);
  const std::uint32_t of_four = alternatives * alternatives * alternatives * alternatives;
  BitWriter bits(out);
  std::uint32_t number = 0;
  std::uint32_t joined = 0;  // words in the number
  for (const std::uint32_t four : fours) {
    number = number * of_four + four;
    if (++joined == packing.fours) {
      bits.put(number, packing.bits);
      number = 0;
      joined = 0;
    }
  }
  if (joined != 0) {
    bits.put(number, packing.rest_bits(joined));
  }
  return bits.finish();
}

}  // namespace iog::tile_coding
