// Converts bits to bytes and back. The most significant bit comes first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "wire/byte_order.hpp"

namespace iog::tile_coding {

// The buffer must be large enough to hold all the bits written. The caller computes the required
// size in advance.
class BitWriter {
 public:
  explicit constexpr BitWriter(std::span<std::byte> buffer)
      : begin_{buffer.data()}, next_{buffer.data()} {}

  // Requires `value` < 2^count and 1 <= count <= 31.
  constexpr void put(std::uint32_t value, unsigned count) {
    if (count <= free_) {
      free_ -= count;
      word_ |= value << free_;
      return;
    }
    const unsigned beyond = count - free_;  // 1 to 31; free_ is 32 only before the first write
    wire::store_be32(std::span<std::byte, 4>(next_, 4), word_ | value >> beyond);
    next_ += 4;
    free_ = 32 - beyond;
    word_ = value << free_;
  }

  // Pads the last byte with zeros and returns the number of bytes written. Do not call put()
  // afterwards.
  constexpr std::size_t finish() {
    for (unsigned used = 32 - free_; used > 0; used -= used < 8 ? used : 8) {
      *next_++ = static_cast<std::byte>(word_ >> 24);
      word_ <<= 8;
    }
    free_ = 32;
    return static_cast<std::size_t>(next_ - begin_);
  }

 private:
  std::byte* begin_;
  std::byte* next_;
  std::uint32_t word_ = 0;  // pending bits, starting at the top bit
  unsigned free_ = 32;      // number of free bits in word_
};

// A read beyond the end returns zero bits and makes ok() return false from then on.
class BitReader {
 public:
  explicit constexpr BitReader(std::span<const std::byte> bytes) : bytes_{bytes} {}

  [[nodiscard]] constexpr bool bit() {
    if (position_ / 8 >= bytes_.size()) {
      ok_ = false;
      return false;
    }
    const auto byte = std::to_integer<std::uint32_t>(bytes_[position_ / 8]);
    const bool value = ((byte >> (7 - position_ % 8)) & 1U) != 0;
    ++position_;
    return value;
  }

  // Requires count <= 32.
  [[nodiscard]] constexpr std::uint32_t bits(unsigned count) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < count; ++i) {
      value = (value << 1) | (bit() ? 1U : 0U);
    }
    return value;
  }

  // Returns true if nothing remains except the zero padding of the last byte.
  [[nodiscard]] constexpr bool ends_here() {
    const std::size_t padding = bytes_.size() * 8 - position_;
    return ok_ && padding < 8 && bits(static_cast<unsigned>(padding)) == 0;
  }

  [[nodiscard]] constexpr bool ok() const { return ok_; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;  // bit position
  bool ok_ = true;
};

}  // namespace iog::tile_coding
