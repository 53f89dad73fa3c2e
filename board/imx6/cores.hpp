// Cores 1 to 3 as core 0 sees them, started by the SRC. Satisfies hal::Cores.
//
// A helper that has ended keeps its caches on and answers the others' snoops. It is not put back
// into reset: what its cache alone holds would be lost with it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/cores.hpp"
#include "helper_cores.hpp"
#include "registers/gic.hpp"
#include "registers/mpcore.hpp"
#include "registers/src.hpp"
#include "time/gpt_clock.hpp"

namespace iog::imx6 {

class Cores : public board::HelperCores<GicDistributorRegisters, GptClock> {
 public:
  // entry: where a helper begins, as the bus sees it.
  Cores(SrcRegisters& src, const ScuRegisters& scu, GicDistributorRegisters& distributor,
        GptClock& clock, Helpers& helpers, std::uint32_t entry)
      : HelperCores(distributor, clock, helpers), src_(src), scu_(scu), entry_(entry) {}

  // As hal::Cores. The GIC has been started.
  std::size_t count() const;
  bool start(std::size_t core, hal::CoreJob job);

 private:
  SrcRegisters& src_;
  const ScuRegisters& scu_;
  std::uint32_t entry_;
};

}  // namespace iog::imx6
