// Programmer errors: a broken contract stops the machine and says which one and where.
//
// Operating errors (a bad frame, a link that is down) are never reported here: they are statuses
// and counters. A panic prints a last word, records it for the next boot and lets the watchdog
// reset.
#pragma once

#include <cstdint>
#include <source_location>

namespace iog::imx6 {

enum class PanicId : std::uint32_t {
  kReleaseWithoutFrame = 1,  // EthernetPort::release() without a frame from receive()
  kCommitWithoutBuffer = 2,  // EthernetPort::commit() without a buffer from acquire()
  kCommitLength = 3,         // EthernetPort::commit() of fewer than 14 or more than 1514 bytes
  kRegionOverlap = 4,        // the memory map handed to the MMU is not made of sections
};

// On the target: fault.cpp. In the tests: tests/host/fakes/panic.cpp throws.
[[noreturn]] void panic(PanicId id, std::source_location where = std::source_location::current());

inline void require(bool contract, PanicId id,
                    std::source_location where = std::source_location::current()) {
  if (!contract) [[unlikely]] {
    panic(id, where);
  }
}

}  // namespace iog::imx6
