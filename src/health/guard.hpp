// Guard words around memory with many writers, such as grids or the rings of a DMA engine. No code
// writes these words after start-up, so a changed value reveals an overrun. They protect adjacent
// memory where no unmapped page can be placed in between. The memory check treats them as regions
// (health/memory_check.hpp).
//
// A class with such members has for_each_guard(visit). It calls visit(guard) for each guard,
// including the guards of its members, from low to high addresses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::health {

// A guard is two cache lines long. It is zero until set() is called, so it can be placed in
// zero-initialised memory.
struct Guard {
  static constexpr std::uint32_t kWord = 0x6775'6172;  // not a plausible address, cell or count

  void set() { words.fill(kWord); }
  [[nodiscard]] std::span<const std::byte> bytes() const { return std::as_bytes(std::span(words)); }

  std::array<std::uint32_t, 16> words{};
};

}  // namespace iog::health
