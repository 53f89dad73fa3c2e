// The values of a tile by number: few tiles have more than sixteen.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::tile_coding {

[[nodiscard]] constexpr unsigned leading_zeros(std::size_t number) {
  return static_cast<unsigned>(std::countl_zero(static_cast<std::uint32_t>(number)));
}

// Bits of a number: 0 for 0.
[[nodiscard]] constexpr unsigned bit_width(std::size_t number) {
  return 32 - leading_zeros(number);
}

// Bits that tell `count` symbols apart: 0 for one symbol.
[[nodiscard]] constexpr unsigned symbol_bits(std::size_t count) {
  return count < 2 ? 0U : bit_width(count - 1);
}

// Numbers values in the order in which they are first asked for. At most 255 of them: a tile has no
// index -128.
class Palette {
 public:
  void clear() {
    symbols_.fill(kNone);
    count_ = 0;
  }

  [[nodiscard]] std::uint8_t symbol_of(std::byte value) {
    std::uint8_t& symbol = symbols_[std::to_integer<std::size_t>(value)];
    if (symbol == kNone) {
      if (count_ == kNone) {
        symbol = 0;  // -128 after all: no symbol is left
        return symbol;
      }
      symbol = static_cast<std::uint8_t>(count_);
      values_[count_++] = value;
    }
    return symbol;
  }

  // Of a value that was asked for before.
  [[nodiscard]] std::uint8_t known_symbol_of(std::byte value) const {
    return symbols_[std::to_integer<std::size_t>(value)];
  }

  [[nodiscard]] std::span<const std::byte> values() const {
    return std::span(values_).first(count_);
  }

 private:
  static constexpr std::uint8_t kNone = 0xFF;

  std::array<std::uint8_t, 256> symbols_{};
  std::array<std::byte, 256> values_{};
  std::size_t count_ = 0;
};

}  // namespace iog::tile_coding
