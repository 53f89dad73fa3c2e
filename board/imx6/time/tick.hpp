// A periodic interrupt request that only ends the loop's sleep and is never taken (gic.hpp).
#pragma once

#include "registers/epit.hpp"

namespace iog::imx6 {

class Tick {
 public:
  static constexpr std::uint32_t kPeriodUs = 1000;

  explicit Tick(EpitRegisters& registers) : registers_(registers) {}

  void start();

  // Withdraws the request until the next period ends.
  void clear() { registers_.sr.clear(EpitRegisters::kSrCompare); }

 private:
  EpitRegisters& registers_;
};

}  // namespace iog::imx6
