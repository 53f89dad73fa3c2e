// Words around memory that many write, such as grids or the rings of a DMA engine. Nothing writes
// the words, so another value shows an overrun. They are a region of the check of memory
// (health/memory_check.hpp), where no page can be left unmapped between neighbours.
//
// A class that has such members has for_each_guard(visit), which calls visit(guard) for each of
// them and those of its parts, from low to high.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::health {

// As long as two lines of the caches. Zeros until it is set: it may lie in memory that begins as
// zeros.
struct Guard {
  static constexpr std::uint32_t kWord = 0x6775'6172;  // no address, no cell, no count

  void set() { words.fill(kWord); }
  [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(words)); }

  std::array<std::uint32_t, 16> words{};
};

}  // namespace iog::health
