#include "constant_memory.hpp"

#include "ethernet/enet_port.hpp"
#include "memory.hpp"
#include "require/require.hpp"

namespace iog::imx6 {
namespace {

// NOLINTNEXTLINE(readability-identifier-naming): a symbol of the linker script
extern "C" const std::array<ImageSeal, 3> image_seal;

std::span<const std::byte> memory_from(std::uint32_t begin, std::uint32_t end) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the linker's tables hold addresses
  return {reinterpret_cast<const std::byte*>(begin), end - begin};
}

}  // namespace

ConstantMemory::ConstantMemory() {
  const mmu::MemoryMap& map = memory_map();
  add_sealed("vectors", image_seal[0]);
  add_sealed("code", image_seal[1]);
  add_sealed("constants", image_seal[2]);
  add("the car's block", memory_from(map.constants[0].begin, map.constants[0].end));
  add("translation tables", std::as_bytes(std::span(&translation_tables(), 1)));
  for (health::Guard* const guard : guards_of(enet_memory)) {
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

}  // namespace iog::imx6
