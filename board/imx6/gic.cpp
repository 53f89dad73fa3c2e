// GIC by ARM IHI 0048. The core is in Secure state and all interrupts stay in group 0.
#include "gic.hpp"

namespace iog::imx6 {
namespace {

constexpr std::uint8_t kPriority = 0xa0;  // anything above the mask of 0xff in urgency
constexpr std::uint8_t kCore0 = 1u << 0;

void let_through(GicDistributorRegisters& distributor, unsigned interrupt) {
  distributor.ipriorityr[interrupt].write(kPriority);
  distributor.itargetsr[interrupt].write(kCore0);
  distributor.isenabler[interrupt / 32].write(1u << (interrupt % 32));
}

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
  // Group 0, level-sensitive: the reset state, written because of the loader.
  for (Rw32& word : distributor.igroupr) {
    word.write(0);
  }
  for (unsigned word = 2; word < GicDistributorRegisters::kInterrupts / 16; ++word) {
    distributor.icfgr[word].write(0);  // words 0 and 1 are the private interrupts, fixed
  }
  let_through(distributor, kInterruptUart1);
  let_through(distributor, kInterruptEpit1);
  let_through(distributor, kInterruptEnet);
  // Enable alone: FIQEn (bit 3) would turn group 0 into fast interrupts.
  cpu.pmr.write(GicCpuRegisters::kPmrAll);
  cpu.ctlr.write(GicCpuRegisters::kCtlrEnable);
  distributor.ctlr.write(GicDistributorRegisters::kCtlrEnable);
}

}  // namespace iog::imx6
