#include "memory/mmu.hpp"

#include "require/require.hpp"

namespace iog::imx6::mmu {
namespace {

void put(std::uint32_t& entry, std::uint32_t descriptor) {
  require(entry == kFault);
  entry = descriptor;
}

// One descriptor at this address: the largest that its table, the alignment and the end allow.
// Returns the bytes that it maps.
std::uint32_t map_next(Tables& tables, const MemoryMap& map, const Range& rest, Memory memory) {
  const auto fits = [&rest](std::uint32_t bytes) {
    return rest.begin % bytes == 0 && rest.end - rest.begin >= bytes;
  };
  const std::uint32_t section_begin = rest.begin & ~(kSectionBytes - 1);
  const bool is_of_image = section_begin == map.image_section;
  if (!is_of_image && section_begin != map.stack_section) {
    require(fits(kSectionBytes));
    put(tables.sections[rest.begin / kSectionBytes], section(rest.begin, memory));
    return kSectionBytes;
  }
  auto& pages = (is_of_image ? tables.image : tables.stacks).pages;
  const std::uint32_t first = (rest.begin - section_begin) / kPageBytes;
  if (!fits(kLargePageBytes)) {
    require(fits(kPageBytes));
    put(pages[first], small_page(rest.begin, memory));
    return kPageBytes;
  }
  constexpr std::uint32_t kEntries = kLargePageBytes / kPageBytes;
  for (std::uint32_t entry = first; entry < first + kEntries; ++entry) {
    put(pages[entry], large_page(rest.begin, memory));
  }
  return kLargePageBytes;
}

void map_range(Tables& tables, const MemoryMap& map, Range range, Memory memory) {
  while (range.begin != range.end) {
    range.begin += map_next(tables, map, range, memory);
  }
}

// Whole ones: what begins or ends within one could take a guard of its neighbour's.
void map_sections(Tables& tables, const MemoryMap& map, const Range& range, Memory memory) {
  require(range.begin % kSectionBytes == 0 && range.end % kSectionBytes == 0);
  map_range(tables, map, range, memory);
}

void map_all(Tables& tables, const MemoryMap& map, std::span<const Range> ranges, Memory memory) {
  for (const Range& range : ranges) {
    map_range(tables, map, range, memory);
  }
}

}  // namespace

void build(Tables& tables, const MemoryMap& map, std::uint32_t image_address,
           std::uint32_t stacks_address) {
  tables.sections.fill(kFault);
  tables.image.pages.fill(kFault);
  tables.stacks.pages.fill(kFault);
  put(tables.sections[map.image_section / kSectionBytes], page_table(image_address));
  put(tables.sections[map.stack_section / kSectionBytes], page_table(stacks_address));
  map_all(tables, map, map.code, Memory::kCode);
  map_all(tables, map, map.constants, Memory::kConstants);
  map_sections(tables, map, map.data, Memory::kData);
  map_sections(tables, map, map.dma, Memory::kUncached);
  map_sections(tables, map, map.boot_record, Memory::kUncached);
  for (const Range& range : map.devices) {
    map_sections(tables, map, range, Memory::kDevice);
  }
  map_range(tables, map, map.tables, Memory::kConstants);
  map_all(tables, map, map.stacks, Memory::kData);
}

bool in_stack_guard(const MemoryMap& map, std::uint32_t address) {
  if (address - map.stack_section >= kSectionBytes || map.tables.contains(address)) {
    return false;
  }
  for (const Range& stack : map.stacks) {
    if (stack.contains(address)) {
      return false;
    }
  }
  return true;
}

}  // namespace iog::imx6::mmu
