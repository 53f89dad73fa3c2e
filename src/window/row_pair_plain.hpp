// Two rows of bits at once in plain C++: the specification, and for machines without more.
#pragma once

#include <cstdint>

namespace iog::window {

class PlainRowPair {
 public:
  // Two rows that follow each other.
  static PlainRowPair load(const std::uint64_t* from) { return {from[0], from[1]}; }
  void store(std::uint64_t* to) const {
    to[0] = first_;
    to[1] = second_;
  }

  // Bits 16 to 47 of both.
  void store_middle(std::uint32_t* to) const {
    to[0] = static_cast<std::uint32_t>(first_ >> 16);
    to[1] = static_cast<std::uint32_t>(second_ >> 16);
  }

  [[nodiscard]] PlainRowPair bit_and(PlainRowPair other) const {
    return {first_ & other.first_, second_ & other.second_};
  }
  [[nodiscard]] PlainRowPair bit_or(PlainRowPair other) const {
    return {first_ | other.first_, second_ | other.second_};
  }
  [[nodiscard]] PlainRowPair and_not(PlainRowPair other) const {
    return {first_ & ~other.first_, second_ & ~other.second_};
  }

  // By so many bits, towards the higher ones and towards the lower ones; zeros follow.
  template <int kBits>
  [[nodiscard]] PlainRowPair up() const {
    return {first_ << kBits, second_ << kBits};
  }
  template <int kBits>
  [[nodiscard]] PlainRowPair down() const {
    return {first_ >> kBits, second_ >> kBits};
  }

 private:
  PlainRowPair(std::uint64_t first, std::uint64_t second) : first_(first), second_(second) {}

  std::uint64_t first_;
  std::uint64_t second_;
};

}  // namespace iog::window
