#include "memory/mmu.hpp"

#include "require/require.hpp"

namespace iog::imx6::mmu {
namespace {

void map_sections(Tables& tables, const Range& range, Memory memory) {
  require(range.begin % kSectionBytes == 0 && range.end % kSectionBytes == 0);
  for (std::uint32_t address = range.begin; address != range.end; address += kSectionBytes) {
    std::uint32_t& entry = tables.sections[address / kSectionBytes];
    require(entry == kFault);
    entry = section(address, memory);
  }
}

}  // namespace

void build(Tables& tables, const MemoryMap& map, std::uint32_t stack_pages_address) {
  tables.sections.fill(kFault);
  tables.stack_pages.fill(kFault);
  map_sections(tables, map.code, Memory::kCode);
  map_sections(tables, map.data, Memory::kData);
  map_sections(tables, map.dma, Memory::kUncached);
  map_sections(tables, map.boot_record, Memory::kUncached);
  for (const Range& range : map.devices) {
    map_sections(tables, range, Memory::kDevice);
  }
  std::uint32_t& entry = tables.sections[map.stack_section / kSectionBytes];
  require(entry == kFault);
  entry = page_table(stack_pages_address);
  for (const Range& stack : map.stacks) {
    for (std::uint32_t page = stack.begin; page != stack.end; page += kPageBytes) {
      tables.stack_pages[(page - map.stack_section) / kPageBytes] = small_page(page, Memory::kData);
    }
  }
}

bool in_stack_guard(const MemoryMap& map, std::uint32_t address) {
  if (address - map.stack_section >= kSectionBytes) {
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
