// Builds the translation tables, which alone define the permitted accesses to every address.
//
// Addresses are mapped one to one, in sections of 1 MiB. Two sections have second-level tables. In
// the section of the stacks, the page below each stack is unmapped, and the tables themselves are
// read-only. The first section of the image maps code and constants in pages of 4 and 64 KiB. All
// other accesses fault, such as accesses to null pointers, the boot ROM, other peripherals, and
// addresses past the end of DDR.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace iog::imx6::mmu {

inline constexpr std::uint32_t kSectionBytes = 1u << 20;
inline constexpr std::uint32_t kLargePageBytes = 1u << 16;
inline constexpr std::uint32_t kPageBytes = 1u << 12;
inline constexpr std::uint32_t kFault = 0;

enum class Memory : std::uint8_t {
  kCode,       // cached, read-only, executable
  kConstants,  // cached, read-only, never executed
  kData,       // cached, read and write, never executed
  kUncached,   // normal memory without caches, for DMA and for the boot record; never executed
  kDevice,     // strongly ordered, never executed
};

namespace detail {

// TEX, C and B specify the memory type (ARM ARM table B3-10, TEX remap off). S makes memory
// shareable, which the Cortex-A9 requires for cached memory if ACTLR.SMP is set. AP[2:0] is 0b001
// for privileged read and write, and 0b101 for privileged read only.
struct Attributes {
  std::uint32_t tex;
  std::uint32_t c;
  std::uint32_t b;
  std::uint32_t s;
  std::uint32_t ap2;
  std::uint32_t xn;
};

constexpr Attributes attributes(Memory memory) {
  switch (memory) {
    case Memory::kCode:
      return {.tex = 1, .c = 1, .b = 1, .s = 1, .ap2 = 1, .xn = 0};
    case Memory::kConstants:
      return {.tex = 1, .c = 1, .b = 1, .s = 1, .ap2 = 1, .xn = 1};
    case Memory::kData:
      return {.tex = 1, .c = 1, .b = 1, .s = 1, .ap2 = 0, .xn = 1};
    case Memory::kUncached:
      return {.tex = 1, .c = 0, .b = 0, .s = 1, .ap2 = 0, .xn = 1};
    case Memory::kDevice:
      break;
  }
  return {.tex = 0, .c = 0, .b = 0, .s = 0, .ap2 = 0, .xn = 1};
}

inline constexpr std::uint32_t kAp10Privileged = 0b01;

}  // namespace detail

// The short descriptors of ARM ARM B3.5 for domain 0, privileged access only. Addresses are rounded
// down to the section or page.
constexpr std::uint32_t section(std::uint32_t address, Memory memory) {
  const detail::Attributes a = detail::attributes(memory);
  return (address & ~(kSectionBytes - 1)) | a.s << 16 | a.ap2 << 15 | a.tex << 12 |
         detail::kAp10Privileged << 10 | a.xn << 4 | a.c << 3 | a.b << 2 | 0b10;
}

constexpr std::uint32_t small_page(std::uint32_t address, Memory memory) {
  const detail::Attributes a = detail::attributes(memory);
  return (address & ~(kPageBytes - 1)) | a.s << 10 | a.ap2 << 9 | a.tex << 6 |
         detail::kAp10Privileged << 4 | a.c << 3 | a.b << 2 | 0b10 | a.xn;
}

// A large page takes 16 consecutive entries.
constexpr std::uint32_t large_page(std::uint32_t address, Memory memory) {
  const detail::Attributes a = detail::attributes(memory);
  return (address & ~(kLargePageBytes - 1)) | a.xn << 15 | a.tex << 12 | a.s << 10 | a.ap2 << 9 |
         detail::kAp10Privileged << 4 | a.c << 3 | a.b << 2 | 0b01;
}

constexpr std::uint32_t page_table(std::uint32_t table_address) {
  return (table_address & ~0x3ffu) | 0b01;
}

// The addresses from begin to end, excluding end.
struct Range {
  std::uint32_t begin;
  std::uint32_t end;

  constexpr bool contains(std::uint32_t address) const { return begin <= address && address < end; }
};

// The map that linker/imx6.ld defines. In sections with a table, ranges begin and end at page
// boundaries. In other sections, ranges begin and end at section boundaries.
struct MemoryMap {
  std::uint32_t image_section;     // has a table
  std::array<Range, 2> code;       // vectors, text
  std::array<Range, 2> constants;  // the car's block, constants
  Range data;
  Range dma;
  Range boot_record;
  std::uint32_t stack_section;  // has the other table
  Range tables;                 // in that section; read-only once they are active
  std::span<const Range> stacks;
  std::span<const Range> devices;
};

struct PageTable {
  alignas(1024) std::array<std::uint32_t, 256> pages;
};

struct Tables {
  alignas(16 * 1024) std::array<std::uint32_t, 4096> sections;
  PageTable image;
  PageTable stacks;
};

// Fills the tables. `bus_address(table)` is the bus address of a page table.
void build(Tables& tables, const MemoryMap& map, std::uint32_t image_address,
           std::uint32_t stacks_address);

// Returns true if the address is in a guard page, that is, in the section of the stacks, but in no
// stack and no table.
bool in_stack_guard(const MemoryMap& map, std::uint32_t address);

}  // namespace iog::imx6::mmu
