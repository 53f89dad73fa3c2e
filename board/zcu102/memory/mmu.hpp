// Builds the translation tables, which alone define the permitted accesses to every address.
//
// Addresses from 0 to 4 GiB are mapped one to one, in blocks of 2 MiB, or in pages of 4 KiB where a
// range does not fill a block. All other accesses fault, such as accesses to null pointers, other
// peripherals, guards below the stacks, and addresses past the end of DDR.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace iog::zcu102::mmu {

inline constexpr std::uint64_t kBlockBytes = 1u << 21;
inline constexpr std::uint64_t kPageBytes = 1u << 12;
inline constexpr std::uint64_t kFault = 0;

enum class Memory : std::uint8_t {
  kCode,       // cached, read-only, executable
  kConstants,  // cached, read-only, never executed
  kData,       // cached, read and write, never executed
  kUncached,   // normal memory without caches, for DMA and for the boot record; never executed
  kDevice,     // never executed
};

// Returns the lower and upper attributes of a VMSAv8-64 block or page for EL1 only (ARM ARM,
// D5.3.3). The memory type is an index into MAIR_EL1, which startup.S sets.
constexpr std::uint64_t attributes(Memory memory) {
  constexpr std::uint64_t kAccessed = 1u << 10;
  constexpr std::uint64_t kInnerShareable = 3u << 8;
  constexpr std::uint64_t kReadOnly = 1u << 7;
  constexpr std::uint64_t kNeverExecuted = std::uint64_t{3} << 53;
  constexpr std::uint64_t kDevice = 0u << 2;
  constexpr std::uint64_t kCached = 1u << 2;
  constexpr std::uint64_t kNotCached = 2u << 2;
  switch (memory) {
    case Memory::kCode:
      return kAccessed | kInnerShareable | kCached | kReadOnly;
    case Memory::kConstants:
      return kAccessed | kInnerShareable | kCached | kReadOnly | kNeverExecuted;
    case Memory::kData:
      return kAccessed | kInnerShareable | kCached | kNeverExecuted;
    case Memory::kUncached:
      return kAccessed | kInnerShareable | kNotCached | kNeverExecuted;
    case Memory::kDevice:
      break;
  }
  return kAccessed | kDevice | kNeverExecuted;
}

constexpr std::uint64_t block(std::uint64_t address, Memory memory) {
  return (address & ~(kBlockBytes - 1)) | attributes(memory) | 0b01;
}
constexpr std::uint64_t page(std::uint64_t address, Memory memory) {
  return (address & ~(kPageBytes - 1)) | attributes(memory) | 0b11;
}
constexpr std::uint64_t table(std::uint64_t address) { return address | 0b11; }

// The addresses from begin to end, excluding end. Both begin and end are page boundaries.
struct Range {
  std::uint64_t begin;
  std::uint64_t end;
  Memory memory;
};

// Level 1 has an entry for each GiB, level 2 has an entry for each 2 MiB, and level 3 has an entry
// for each page. Tables of levels 2 and 3 are taken from `pool` as needed.
struct Tables {
  using Table = std::array<std::uint64_t, 512>;
  alignas(kPageBytes) Table level1;
  alignas(kPageBytes) std::array<Table, 10> pool;
};

// Fills the tables, which are located at `bus_address`.
void build(Tables& tables, std::span<const Range> ranges, std::uint64_t bus_address);

}  // namespace iog::zcu102::mmu
