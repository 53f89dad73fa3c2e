// Cores 1 to 3 as core 0 sees them, started by PSCI. Satisfies hal::Cores.
//
// A helper that has ended is not switched off: what its cache alone holds would be lost with it.
#pragma once

#include <cstddef>

#include "hal/cores.hpp"
#include "helper_cores.hpp"
#include "registers/gic.hpp"
#include "time/clock.hpp"

namespace iog::zcu102 {

class Cores : public board::HelperCores<GicDistributorRegisters, Clock> {
 public:
  Cores(GicDistributorRegisters& distributor, Clock& clock, Helpers& helpers)
      : HelperCores(distributor, clock, helpers) {}

  // As hal::Cores. The GIC has been started.
  std::size_t count() const;
  bool start(std::size_t core, hal::CoreJob job);
};

}  // namespace iog::zcu102
