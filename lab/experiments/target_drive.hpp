// The drive that is measured on the target (lab/target/measure_a9): that of `iog simulate` with
// these numbers, in each scene. What is computed beside it on the PC is computed of the same drive.
#pragma once

#include <cstdint>

namespace iog::lab {

inline constexpr std::uint64_t kTargetSeed = 1;
inline constexpr std::uint32_t kTargetSeconds = 2;

}  // namespace iog::lab
