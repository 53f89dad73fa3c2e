// A set of window slots, with one bit per slot.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "window/area.hpp"

namespace iog::map {

class SlotSet {
 public:
  void set(std::size_t slot, bool is_in) {
    const std::uint32_t bit = 1U << slot % kBits;
    std::uint32_t& word = words_[slot / kBits];
    word = is_in ? word | bit : word & ~bit;
  }

  // Returns the first slot in the set, starting the search at `slot`. If there is no such slot,
  // returns kSlotCount.
  [[nodiscard]] std::size_t first_from(std::size_t slot) const {
    if (slot >= window::kSlotCount) {
      return window::kSlotCount;
    }
    std::size_t word = slot / kBits;
    std::uint32_t bits = words_[word] & ~0U << slot % kBits;
    while (bits == 0 && word + 1 < words_.size()) {
      bits = words_[++word];
    }
    return bits == 0 ? window::kSlotCount
                     : word * kBits + static_cast<std::size_t>(std::countr_zero(bits));
  }

 private:
  static constexpr std::size_t kBits = 32;

  std::array<std::uint32_t, window::kSlotCount / kBits> words_{};
};

}  // namespace iog::map
