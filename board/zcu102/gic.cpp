// GIC-400 by ARM IHI 0048, as the Non-secure state sees it: bit 0 enables group 1.
#include "gic.hpp"

#include "helper.hpp"
#include "peripherals.hpp"

namespace iog::zcu102 {
namespace {

constexpr std::uint8_t kPriority = 0xa0;
constexpr std::uint8_t kCore0 = 1u << 0;

}  // namespace

void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu) {
  distributor.ctlr.write(0);
  cpu.ctlr.write(0);
  // A loader may have left lines enabled and edges pending.
  for (Rw32& word : distributor.icenabler) {
    word.write(0xffff'ffff);
  }
  for (Rw32& word : distributor.icpendr) {
    word.write(0xffff'ffff);
  }
  for (unsigned word = 2; word < GicDistributorRegisters::kInterrupts / 16; ++word) {
    distributor.icfgr[word].write(0);  // level-sensitive
  }
  for (const unsigned interrupt : {kInterruptTimer, kInterruptGem3}) {
    distributor.ipriorityr[interrupt].write(kPriority);
    distributor.itargetsr[interrupt].write(kCore0);
    distributor.isenabler[interrupt / 32].write(1u << (interrupt % 32));
  }
  cpu.pmr.write(GicCpuRegisters::kPmrAll);
  cpu.ctlr.write(GicCpuRegisters::kCtlrEnable);
  distributor.ctlr.write(GicDistributorRegisters::kCtlrEnable);
}

}  // namespace iog::zcu102

namespace iog {

// Software-generated interrupts 0 and 1 are enabled for every core; the CPU interface is its own.
void board::hear_core_0() {
  zcu102::gic_cpu.pmr.write(zcu102::GicCpuRegisters::kPmrAll);
  zcu102::gic_cpu.ctlr.write(zcu102::GicCpuRegisters::kCtlrEnable);
}

void board::hear_nobody() { zcu102::gic_cpu.ctlr.write(0); }

}  // namespace iog
