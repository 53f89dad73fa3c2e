// Guard words surround memory that many components write to, such as grids or DMA rings. No code
// writes guard words after start-up, so a changed value indicates an overrun. Guard words are used
// where an unmapped page cannot protect the adjacent memory. The memory check covers guard words
// like other constant memory (health/memory_check.hpp).
//
// A class with guards has a member function for_each_guard(visit). This function calls visit(guard)
// for each guard of the object and its members, in ascending order of address.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::health {

// A guard is two cache lines long. Guards are zero until set() is called, so they can be placed in
// zero-initialised memory.
struct Guard {
  static constexpr std::uint32_t kWord = 0x6775'6172;  // not a plausible address, cell or count

  void set() { words.fill(kWord); }
  [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(words)); }

  std::array<std::uint32_t, 16> words{};
};

}  // namespace iog::health
