// Hardware interface for a number that distinguishes the runs of a machine.
#pragma once

#include <concepts>
#include <cstdint>

namespace iog::hal {

// `run_number()` returns a number that is constant within a run and different after each start. A
// reset increments the number. A power-up draws an unpredictable number. The probability that two
// of these numbers are equal is 2^-32.
template <typename T>
concept RunNumber = requires(const T& machine) {
  { machine.run_number() } -> std::same_as<std::uint32_t>;
};

}  // namespace iog::hal
