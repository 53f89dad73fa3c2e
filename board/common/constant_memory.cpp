#include "constant_memory.hpp"

#include "require/require.hpp"

namespace iog::board {
namespace {

// Of the linker script.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" const std::array<ImageSeal, 3> image_seal;
extern "C" const std::byte car_block;
extern "C" const std::byte car_block_end;
// NOLINTEND(readability-identifier-naming)

std::span<const std::byte> memory_from(std::uint32_t begin, std::uint32_t end) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the linker's tables hold addresses
  return {reinterpret_cast<const std::byte*>(std::uintptr_t{begin}), end - begin};
}

}  // namespace

ConstantMemory::ConstantMemory(std::span<const std::byte> translation_tables,
                               std::span<health::Guard* const> ring_guards) {
  add_sealed("vectors", image_seal[0]);
  add_sealed("code", image_seal[1]);
  add_sealed("constants", image_seal[2]);
  add("the car's block", {&car_block, &car_block_end});
  add("translation tables", translation_tables);
  for (health::Guard* const guard : ring_guards) {
    add("a guard of the Ethernet rings", *guard);
  }
}

void ConstantMemory::add(std::string_view name, std::span<const std::byte> bytes) {
  require(count_ < regions_.size());
  regions_[count_++] = {.name = name, .bytes = bytes, .crc = health::crc_of(bytes)};
}

void ConstantMemory::add(std::string_view name, health::Guard& guard) {
  guard.set();
  add(name, guard.bytes());
}

void ConstantMemory::add_sealed(std::string_view name, const ImageSeal& seal) {
  require(count_ < regions_.size());
  regions_[count_++] = {.name = name, .bytes = memory_from(seal.begin, seal.end), .crc = seal.crc};
}

}  // namespace iog::board
