// A core in a state that a loader may leave it in.
#pragma once

#include <atomic>

#include "board.hpp"
#include "peripherals.hpp"
#include "require/require.hpp"

namespace iog::tests {

// As a loader may leave a core: its private interrupts, those that wake and stop it, are in
// group 1.
inline void leave_a_core(imx6::Board& board) {
  static std::atomic<bool> is_left{false};
  const auto leave = [](void*, std::size_t) {
    imx6::gic_distributor.igroupr[0].write(0xffff'ffff);
    is_left.store(true, std::memory_order_release);
  };
  require(board.cores().start(1, {.run = leave}));
  board.cores().wake(1);
  while (!is_left.load(std::memory_order_acquire)) {
    machine::yield();
  }
  // QEMU takes some time to stop a core that has a thread of its own.
  imx6::src.scr.clear_bits(1u << imx6::SrcRegisters::kScrCore1EnableShift);
  board.clock().wait_us(50'000);
}

}  // namespace iog::tests
