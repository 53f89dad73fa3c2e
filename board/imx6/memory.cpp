// MMU and caches on, in the order of the Cortex-A9 MPCore TRM (ARM DDI 0407, 5.3.4 and 2.2):
// tables, snoop control unit, ACTLR.SMP, L2, then everything in SCTLR at once.
#include "memory.hpp"

#include <array>

#include "l2_cache.hpp"
#include "peripherals.hpp"

namespace iog::imx6 {
namespace {

// Only the addresses of these mean something (linker/imx6.ld).
extern "C" {
extern std::uint32_t code_begin, code_end, data_begin, data_end, dma_begin, dma_end;
extern std::uint32_t boot_record_section, stacks_begin;
extern std::uint32_t main_stack_bottom, main_stack_top, undefined_stack_bottom;
extern std::uint32_t undefined_stack_top, abort_stack_bottom, abort_stack_top;
extern std::uint32_t irq_stack_bottom, irq_stack_top, fiq_stack_bottom, fiq_stack_top;
}

std::uint32_t address_of(const std::uint32_t& symbol) { return machine::bus_address(symbol); }

[[gnu::section(".page_tables")]] constinit mmu::Tables tables{};

constinit std::array<mmu::Range, 5> stacks{};
// The MPCore block with the PL310, AIPS-1, AIPS-2: every peripheral of linker/peripherals.ld.
constexpr std::array<mmu::Range, 2> kDevices{
    {{0x00a0'0000, 0x00b0'0000}, {0x0200'0000, 0x0220'0000}}};

constinit mmu::MemoryMap map{};

constinit bool l2_cache_on = false;

void read_the_linker() {
  stacks = {{{address_of(main_stack_bottom), address_of(main_stack_top)},
             {address_of(undefined_stack_bottom), address_of(undefined_stack_top)},
             {address_of(abort_stack_bottom), address_of(abort_stack_top)},
             {address_of(irq_stack_bottom), address_of(irq_stack_top)},
             {address_of(fiq_stack_bottom), address_of(fiq_stack_top)}}};
  const std::uint32_t record = address_of(boot_record_section);
  map = {.code = {address_of(code_begin), address_of(code_end)},
         .data = {address_of(data_begin), address_of(data_end)},
         .dma = {address_of(dma_begin), address_of(dma_end)},
         .boot_record = {record, record + mmu::kSectionBytes},
         .stack_section = address_of(stacks_begin),
         .stacks = stacks,
         .devices = kDevices};
}

// SCU first: with ACTLR.SMP set and the SCU off, coherent requests would have nobody to answer
// them. SMP makes shareable write-back memory really cacheable; FW and the prefetch hint come with
// it.
void start_coherency() {
  scu.invalidate_all.write(ScuRegisters::kInvalidateAllWaysAllCores);
  scu.control.set_bits(ScuRegisters::kControlEnable);
  constexpr std::uint32_t kSmp = 1u << 6;
  constexpr std::uint32_t kL1Prefetch = 1u << 2;
  constexpr std::uint32_t kBroadcastMaintenance = 1u << 0;  // FW
  std::uint32_t actlr = 0;
  __asm__ volatile("mrc p15, 0, %0, c1, c0, 1" : "=r"(actlr));
  actlr |= kSmp | kL1Prefetch | kBroadcastMaintenance;
  __asm__ volatile("mcr p15, 0, %0, c1, c0, 1\n\tisb" ::"r"(actlr) : "memory");
}

// Table walks are cached like the tables: write-back, write-allocate, shareable (TTBR0 bits 6, 3,
// 1). All of domain 0 is a client, so the permissions in the descriptors count.
void start_mmu_and_l1() {
  const std::uint32_t ttbr0 = machine::bus_address(tables) | 1u << 6 | 1u << 3 | 1u << 1;
  constexpr std::uint32_t kDomain0Client = 1;
  constexpr std::uint32_t kMmuDataBranchesInstructions = 1u << 0 | 1u << 2 | 1u << 11 | 1u << 12;
  std::uint32_t sctlr = 0;
  __asm__ volatile(
      "dsb\n\t"
      "mcr p15, 0, %1, c2, c0, 2\n\t"  // TTBCR = 0: TTBR0 for all, short descriptors
      "mcr p15, 0, %2, c2, c0, 0\n\t"  // TTBR0
      "mcr p15, 0, %3, c3, c0, 0\n\t"  // DACR
      "mcr p15, 0, %1, c8, c7, 0\n\t"  // TLBIALL
      "mcr p15, 0, %1, c7, c5, 0\n\t"  // ICIALLU
      "mcr p15, 0, %1, c7, c5, 6\n\t"  // BPIALL
      "dsb\n\t"
      "isb\n\t"
      "mrc p15, 0, %0, c1, c0, 0\n\t"
      "orr %0, %0, %4\n\t"
      "mcr p15, 0, %0, c1, c0, 0\n\t"  // SCTLR
      "isb"
      : "=&r"(sctlr)
      : "r"(0), "r"(ttbr0), "r"(kDomain0Client), "r"(kMmuDataBranchesInstructions)
      : "memory");
}

}  // namespace

const mmu::MemoryMap& memory_map() { return map; }

bool l2_cache_is_on() { return l2_cache_on; }

std::uint32_t main_stack_bytes() {
  return address_of(main_stack_top) - address_of(main_stack_bottom);
}

std::uint32_t main_stack_used_bytes() {
  constexpr std::uint32_t kStackPaint = 0x5ac4'ed01;  // as in startup.S
  const std::uint32_t* word = &main_stack_bottom;
  while (word != &main_stack_top && machine::load(*word) == kStackPaint) {
    ++word;
  }
  return address_of(main_stack_top) - machine::bus_address(*word);
}

extern "C" void start_memory() {
  read_the_linker();
  mmu::build(tables, map, machine::bus_address(tables.stack_pages));
  start_coherency();
  l2_cache_on = L2Cache(pl310).start();
  start_mmu_and_l1();
}

}  // namespace iog::imx6
