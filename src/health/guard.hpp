// Guard words surround memory with many writers, such as grids or the rings of a DMA engine. No
// code writes guard words after start-up, so a changed value reveals an overrun. Guard words
// protect adjacent memory where an unmapped page is not possible. The memory check treats guard
// words as regions (health/memory_check.hpp).
//
// A class with guards has a member function for_each_guard(visit), which calls visit(guard) for
// each guard, including the guards of the class's members, from low to high addresses.
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
