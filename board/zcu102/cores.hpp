// Cores 1 to 3 as core 0 sees them, started by PSCI. Satisfies hal::Cores.
//
// A helper that has ended is not switched off: what its cache alone holds would be lost with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "clock.hpp"
#include "hal/cores.hpp"
#include "helper.hpp"
#include "registers/gic.hpp"

namespace iog::zcu102 {

class Cores {
 public:
  Cores(GicDistributorRegisters& distributor, Clock& clock, Helpers& helpers)
      : distributor_(distributor), clock_(clock), helpers_(helpers) {}

  // As hal::Cores. The GIC has been started.
  std::size_t count() const;
  bool start(std::size_t core, hal::CoreJob job);
  hal::CoreState state(std::size_t core) const;
  void wake(std::size_t core);
  bool stop(std::size_t core);
  std::uint64_t now_us() { return clock_.now_us(); }
  void pause() { machine::yield(); }
  std::string_view last_word(std::size_t core) const;

 private:
  void send(std::uint32_t interrupt, std::size_t core);

  GicDistributorRegisters& distributor_;
  Clock& clock_;
  Helpers& helpers_;
};

}  // namespace iog::zcu102
