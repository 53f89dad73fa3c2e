// Lists the memory that must not change while the firmware runs, for the memory check. This memory
// consists of the image sealed by the build, constants set at start-up, and guards around writable
// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "health/guard.hpp"
#include "health/memory_check.hpp"

namespace iog::board {

// One of the ranges of linker/<board>.ld, with the CRC-32 that seal_image has written for the bytes
// of the range.
struct ImageSeal {
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t crc;
};

class ConstantMemory {
 public:
  // Adds the image, the translation tables and the guards of the rings. `docs/spec.md` 3.7 lists
  // the numbers of the regions.
  ConstantMemory(std::span<const std::byte> translation_tables,
                 std::span<health::Guard* const> ring_guards);

  // Adds a region with its current content. The name and the bytes must outlive this object.
  void add(std::string_view name, std::span<const std::byte> bytes);
  // Sets the guard and adds it.
  void add(std::string_view name, health::Guard& guard);

  [[nodiscard]] std::span<const health::Region> regions() const {
    return std::span(regions_).first(count_);
  }

 private:
  void add_sealed(std::string_view name, const ImageSeal& seal);

  std::array<health::Region, 160> regions_{};
  std::size_t count_ = 0;
};

}  // namespace iog::board
