// Hardware interface for a number that distinguishes the runs of a machine.
#pragma once

#include <concepts>
#include <cstdint>

namespace iog::hal {

// run_number():  constant within a run, different after each start. A reset adds one. A power-up
//                draws an unpredictable number; two of them are equal once in 2^32.
template <typename T>
concept RunNumber = requires(const T& machine) {
  { machine.run_number() } -> std::same_as<std::uint32_t>;
};

}  // namespace iog::hal
