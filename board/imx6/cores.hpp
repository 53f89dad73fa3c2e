// Controls cores 1 to 3 from core 0. The SRC starts these cores. The class satisfies hal::Cores.
//
// A helper that has ended keeps its caches on and answers the snoops of other cores. The helper is
// not put back into reset, because data that only its cache contains would be lost.
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
  // `entry` is the bus address at which a helper starts.
  Cores(SrcRegisters& src, const ScuRegisters& scu, GicDistributorRegisters& distributor,
        GptClock& clock, Helpers& helpers, std::uint32_t entry)
      : HelperCores(distributor, clock, helpers), src_(src), scu_(scu), entry_(entry) {}

  // The interface of hal::Cores. The GIC must have been started.
  std::size_t count() const;
  bool start(std::size_t core, hal::CoreJob job);

 private:
  SrcRegisters& src_;
  const ScuRegisters& scu_;
  std::uint32_t entry_;
};

}  // namespace iog::imx6
