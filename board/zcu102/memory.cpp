#include "memory.hpp"

#include "hal/cores.hpp"
#include "machine.hpp"

namespace iog::zcu102 {
namespace {

// Only the addresses of these mean something (linker/zcu102.ld).
extern "C" {
extern std::uint32_t code_begin, car_block, car_block_end, text_begin, constants_begin;
extern std::uint32_t constants_end, data_begin, data_end, dma_begin, dma_end;
extern std::uint32_t boot_noise, page_tables, page_tables_end, stacks_begin, stacks_end;
extern std::uint32_t main_stack_bottom, main_stack_top, exception_stack_bottom;
extern std::uint32_t exception_stack_top, helper_stack_stride, helper_main_stack_bottom;
extern std::uint32_t helper_main_stack_top, helper_exception_stack_bottom;
extern std::uint32_t helper_exception_stack_top;
}

std::uint64_t address_of(const std::uint32_t& symbol) { return machine::bus_address(symbol); }

// Alone in its section, which linker/zcu102.ld names page_tables for startup.S.
[[gnu::section(".page_tables")]] constinit mmu::Tables tables{};

constexpr std::size_t kStacks = 2 + 2 * (hal::kMaxCores - 1);
// The ranges of code, data and the like, of the stacks, of the devices.
constinit std::array<mmu::Range, 8 + kStacks + 4> ranges{};
constinit std::span<const mmu::Range> stacks{};

// The GIC; the watchdog; UARTs and Ethernet controllers; the clocks.
constexpr std::array<mmu::Range, 4> kDevices{{{0xf900'0000, 0xf920'0000, mmu::Memory::kDevice},
                                              {0xfd40'0000, 0xfd60'0000, mmu::Memory::kDevice},
                                              {0xff00'0000, 0xff20'0000, mmu::Memory::kDevice},
                                              {0xff40'0000, 0xff60'0000, mmu::Memory::kDevice}}};

void read_the_linker() {
  using enum mmu::Memory;
  mmu::Range* next = ranges.data();
  const auto put = [&next](const std::uint32_t& begin, const std::uint32_t& end, mmu::Memory memory,
                           std::uint64_t skipped = 0) {
    *next++ = {address_of(begin) + skipped, address_of(end) + skipped, memory};
  };
  const std::uint64_t record = address_of(boot_noise) - mmu::kPageBytes;
  *next++ = {record, record + 2 * mmu::kPageBytes, kUncached};
  put(code_begin, car_block, kCode);
  put(car_block, car_block_end, kConstants);
  put(text_begin, constants_begin, kCode);
  put(constants_begin, constants_end, kConstants);
  put(data_begin, data_end, kData);
  put(page_tables, page_tables_end, kConstants);
  put(dma_begin, dma_end, kUncached);
  const mmu::Range* const first_stack = next;
  put(main_stack_bottom, main_stack_top, kData);
  put(exception_stack_bottom, exception_stack_top, kData);
  for (std::size_t core = 1; core < hal::kMaxCores; ++core) {
    const std::uint64_t skipped = (core - 1) * address_of(helper_stack_stride);
    put(helper_main_stack_bottom, helper_main_stack_top, kData, skipped);
    put(helper_exception_stack_bottom, helper_exception_stack_top, kData, skipped);
  }
  stacks = {first_stack, kStacks};
  for (const mmu::Range& device : kDevices) {
    *next++ = device;
  }
}

}  // namespace

const mmu::Tables& translation_tables() { return tables; }

bool in_stack_guard(std::uint64_t address) {
  if (address < address_of(stacks_begin) || address >= address_of(stacks_end)) {
    return false;
  }
  for (const mmu::Range& stack : stacks) {
    if (stack.begin <= address && address < stack.end) {
      return false;
    }
  }
  return true;
}

extern "C" void start_memory() {
  read_the_linker();
  mmu::build(tables, ranges, machine::bus_address(tables));
}

}  // namespace iog::zcu102
