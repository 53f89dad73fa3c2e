// How much a test may try: a PC does the whole campaign, the emulated Cortex-A9 a sample of it.
#pragma once

#include <cstddef>

namespace iog::tests {

constexpr bool kIsPc = sizeof(void*) == 8;

constexpr int effort(int on_pc, int on_target) { return kIsPc ? on_pc : on_target; }

}  // namespace iog::tests
