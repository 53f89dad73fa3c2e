// Controls cores 1 to 3 from core 0. PSCI starts these cores. The class satisfies hal::Cores.
//
// A helper that has ended is not switched off, because data that only its cache contains would be
// lost.
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

  // The interface of hal::Cores. The GIC must have been started.
  std::size_t count() const;
  bool start(std::size_t core, hal::CoreJob job);
};

}  // namespace iog::zcu102
