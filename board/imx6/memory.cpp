// MMU and caches on, in the order of the Cortex-A9 MPCore TRM (ARM DDI 0407, 5.3.4 and 2.2):
// tables, snoop control unit, L2, then ACTLR.SMP and everything in SCTLR at once.
#include "memory.hpp"

#include <array>

#include "hal/cores.hpp"
#include "memory/l2_cache.hpp"
#include "peripherals.hpp"
#include "watchdog.hpp"

namespace iog::imx6 {
namespace {

// Only the addresses of these mean something (linker/imx6.ld).
extern "C" {
extern std::uint32_t code_begin, car_block, car_block_end, text_begin, constants_begin;
extern std::uint32_t constants_end, data_begin, data_end, dma_begin, dma_end;
extern std::uint32_t boot_record_section, page_tables, page_tables_end;
extern std::uint32_t main_stack_bottom, main_stack_top, undefined_stack_bottom;
extern std::uint32_t undefined_stack_top, abort_stack_bottom, abort_stack_top;
extern std::uint32_t irq_stack_bottom, irq_stack_top, fiq_stack_bottom, fiq_stack_top;
extern std::uint32_t helper_stack_stride, helper_main_stack_bottom, helper_main_stack_top;
extern std::uint32_t helper_exception_stack_bottom, helper_exception_stack_top;

// core_start.S: ACTLR.SMP, then MMU, L1 and branch prediction, with the tables below.
void start_mmu();
}

std::uint32_t address_of(const std::uint32_t& symbol) { return machine::bus_address(symbol); }

// Alone in its section, which linker/imx6.ld names page_tables for core_start.S.
[[gnu::section(".page_tables")]] constinit mmu::Tables tables{};

constinit std::array<mmu::Range, 5 + 2 * (hal::kMaxCores - 1)> stacks{};
// The MPCore block with the PL310, AIPS-1, AIPS-2: every peripheral of linker/imx6_peripherals.ld.
constexpr std::array<mmu::Range, 2> kDevices{
    {{0x00a0'0000, 0x00b0'0000}, {0x0200'0000, 0x0220'0000}}};

constinit mmu::MemoryMap map{};

constinit bool l2_cache_on = false;

void read_the_linker() {
  auto stack = stacks.begin();
  *stack++ = {address_of(main_stack_bottom), address_of(main_stack_top)};
  *stack++ = {address_of(undefined_stack_bottom), address_of(undefined_stack_top)};
  *stack++ = {address_of(abort_stack_bottom), address_of(abort_stack_top)};
  *stack++ = {address_of(irq_stack_bottom), address_of(irq_stack_top)};
  *stack++ = {address_of(fiq_stack_bottom), address_of(fiq_stack_top)};
  const std::uint32_t stride = address_of(helper_stack_stride);
  for (std::uint32_t skipped = 0; stack != stacks.end(); skipped += stride) {
    *stack++ = {address_of(helper_main_stack_bottom) + skipped,
                address_of(helper_main_stack_top) + skipped};
    *stack++ = {address_of(helper_exception_stack_bottom) + skipped,
                address_of(helper_exception_stack_top) + skipped};
  }
  const std::uint32_t record = address_of(boot_record_section);
  // The alignment of the text fills its last page.
  map = {.image_section = address_of(code_begin),
         .code = {{{address_of(code_begin), address_of(car_block)},
                   {address_of(text_begin), address_of(constants_begin)}}},
         .constants = {{{address_of(car_block), address_of(car_block_end)},
                        {address_of(constants_begin), address_of(constants_end)}}},
         .data = {address_of(data_begin), address_of(data_end)},
         .dma = {address_of(dma_begin), address_of(dma_end)},
         .boot_record = {record, record + mmu::kSectionBytes},
         .stack_section = address_of(page_tables),
         .tables = {address_of(page_tables), address_of(page_tables_end)},
         .stacks = stacks,
         .devices = kDevices};
}

}  // namespace

const mmu::MemoryMap& memory_map() { return map; }

const mmu::Tables& translation_tables() { return tables; }

bool l2_cache_is_on() { return l2_cache_on; }

// What is kept here and in fault.cpp is zeroed before this, all other static data after it
// (linker/imx6.ld).
extern "C" void start_memory() {
  Watchdog(wdog1).start();
  read_the_linker();
  mmu::build(tables, map, machine::bus_address(tables.image), machine::bus_address(tables.stacks));
  // SCU first: with ACTLR.SMP set and the SCU off, coherent requests would have nobody to answer
  // them.
  scu.invalidate_all.write(ScuRegisters::kInvalidateAllWaysAllCores);
  scu.control.set_bits(ScuRegisters::kControlEnable);
  l2_cache_on = L2Cache(pl310).start();
  start_mmu();
}

}  // namespace iog::imx6
