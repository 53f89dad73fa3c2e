// Eight adjacent indexes in one word, which are all tested at once.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace iog::lanes {

class EightBytes {
 public:
  static constexpr std::size_t kCount = 8;

  [[nodiscard]] static EightBytes none() { return EightBytes(0); }

  // Returns a word with the byte repeated eight times.
  [[nodiscard]] static constexpr EightBytes all(std::int8_t byte) {
    return EightBytes(static_cast<std::uint8_t>(byte) * std::uint64_t{0x0101010101010101U});
  }

  [[nodiscard]] static EightBytes load(const std::int8_t* from) {
    std::uint64_t word = 0;
    __builtin_memcpy(&word, from, sizeof word);
    return EightBytes(word);
  }

  [[nodiscard]] EightBytes bit_or(EightBytes other) const {
    return EightBytes(word_ | other.word_);
  }

  [[nodiscard]] EightBytes bit_and(EightBytes other) const {
    return EightBytes(word_ & other.word_);
  }

  [[nodiscard]] EightBytes bit_xor(EightBytes other) const {
    return EightBytes(word_ ^ other.word_);
  }

  [[nodiscard]] bool is_zero() const { return word_ == 0; }

  // Returns true if any byte is above 0.
  [[nodiscard]] bool has_positive() const { return tops_of_positive() != 0; }

  // Returns a mask in which bit i is set if byte i is above 0.
  //
  // The multiplication moves the bits at positions `8 * i` to positions `56 + i`. The product is
  // the sum of eight copies of the word, shifted left by `7 * k` bits for `k = 1 ... 8`. The bit at
  // position `8 * i` reaches position `56 + i` only in the copy with `k = 8 - i`. No carry occurs
  // because the 64 sums `8 * i + 7 * k` are all different.
  [[nodiscard]] std::uint8_t positive() const { return gathered(tops_of_positive()); }

 private:
  static constexpr std::uint64_t kSevenBits = 0x7F7F7F7F7F7F7F7FU;
  static constexpr std::uint64_t kTopBits = 0x8080808080808080U;
  static constexpr std::uint64_t kGather = 0x0102040810204080U;
  static_assert(std::endian::native == std::endian::little, "the first byte is the lowest");

  explicit constexpr EightBytes(std::uint64_t word) : word_(word) {}

  [[nodiscard]] static std::uint8_t gathered(std::uint64_t tops) {
    return static_cast<std::uint8_t>((tops >> 7) * kGather >> 56);
  }

  // Returns a word in which bit 7 of each byte is set if the byte is above 0. Adding 127 to the low
  // seven bits carries into bit 7 if and only if one of these bits is set. The addition never
  // carries into the next byte.
  [[nodiscard]] std::uint64_t tops_of_positive() const {
    return ((word_ & kSevenBits) + kSevenBits) & ~word_ & kTopBits;
  }

  std::uint64_t word_;
};

}  // namespace iog::lanes
