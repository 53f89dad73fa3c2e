// The functions of the Power State Coordination Interface (ARM DEN 0022, 5.1), called by SMC.
#pragma once

#include <cstdint>

namespace iog::zcu102::psci {

inline constexpr std::uint64_t kCpuOn = 0xc400'0003;  // core, entry, context
inline constexpr std::uint64_t kSystemReset = 0x8400'0009;
inline constexpr std::int64_t kSuccess = 0;

}  // namespace iog::zcu102::psci
