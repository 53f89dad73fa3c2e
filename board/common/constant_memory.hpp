// What must not change while the firmware runs, for the check of memory: the image as the build has
// sealed it, what the start-up has made, and guards around what is written.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "health/guard.hpp"
#include "health/memory_check.hpp"

namespace iog::board {

// One of the ranges of linker/<board>.ld, with the CRC-32 of its bytes as seal_image has written
// it.
struct ImageSeal {
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t crc;
};

class ConstantMemory {
 public:
  // With the image, these translation tables and the guards of these rings. The numbers of regions
  // are those of docs/spec.md 3.7.
  ConstantMemory(std::span<const std::byte> translation_tables,
                 std::span<health::Guard* const> ring_guards);

  // As it is now. The name and the bytes outlive it.
  void add(std::string_view name, std::span<const std::byte> bytes);
  // Sets it, and adds it.
  void add(std::string_view name, health::Guard& guard);

  [[nodiscard]] std::span<const health::Region> regions() const {
    return std::span(regions_).first(count_);
  }

 private:
  void add_sealed(std::string_view name, const ImageSeal& seal);

  std::array<health::Region, 96> regions_{};
  std::size_t count_ = 0;
};

}  // namespace iog::board
