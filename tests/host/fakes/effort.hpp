// How much a test may try: a PC does the whole campaign; where each step is slow, under the
// sanitizers and on the emulated Cortex-A9, it is a sample.
#pragma once

namespace iog::tests {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kIsQuick = false;
#elif defined(__has_feature)
constexpr bool kIsQuick =
    sizeof(void*) == 8 && !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kIsQuick = sizeof(void*) == 8;
#endif

constexpr int effort(int all, int sample) { return kIsQuick ? all : sample; }

}  // namespace iog::tests
