// The seam to what tells one run of the machine from another.
#pragma once

#include <concepts>
#include <cstdint>

namespace iog::hal {

// run_number():  the same from start to end of a run, another one after each start. A reset adds
//                one. A power-up draws a number that cannot be foreseen, so that two of them are
//                the same once in 2^32.
template <typename T>
concept RunNumber = requires(const T& machine) {
  { machine.run_number() } -> std::same_as<std::uint32_t>;
};

}  // namespace iog::hal
