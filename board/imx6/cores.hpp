// Cores 1 to 3 as core 0 sees them. Satisfies hal::Cores.
//
// A helper that has ended keeps its caches on and answers the others' snoops. It is not put back
// into reset: what its cache alone holds would be lost with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/cores.hpp"
#include "helper.hpp"
#include "registers/gic.hpp"
#include "registers/mpcore.hpp"
#include "registers/src.hpp"
#include "time/gpt_clock.hpp"

namespace iog::imx6 {

class Cores {
 public:
  // entry: where a helper begins, as the bus sees it.
  Cores(SrcRegisters& src, const ScuRegisters& scu, GicDistributorRegisters& distributor,
        GptClock& clock, Helpers& helpers, std::uint32_t entry)
      : src_(src),
        scu_(scu),
        distributor_(distributor),
        clock_(clock),
        helpers_(helpers),
        entry_(entry) {}

  // As hal::Cores. The GIC has been started.
  std::size_t count() const;
  bool start(std::size_t core, hal::CoreJob job);
  hal::CoreState state(std::size_t core) const;
  void wake(std::size_t core);
  bool stop(std::size_t core);
  std::uint64_t now_us() { return clock_.now_us(); }
  void pause() { machine::yield(); }

  // Of a helper that has ended: why and where.
  std::string_view last_word(std::size_t core) const;

 private:
  void send(std::uint32_t interrupt, std::size_t core);

  SrcRegisters& src_;
  const ScuRegisters& scu_;
  GicDistributorRegisters& distributor_;
  GptClock& clock_;
  Helpers& helpers_;
  std::uint32_t entry_;
};

}  // namespace iog::imx6
