// Prefetches cache lines that are needed soon. The compiler never removes an asm without outputs.
#pragma once

#include <cstddef>
#include <span>

namespace iog::lanes {

inline constexpr std::size_t kLineBytes = 32;

// Prefetches the line of a byte by reading it. Two such reads can be in progress at once, whereas
// stores to missing lines wait for each other.
inline void bring_line(const void* byte) { asm("" : : "r"(*static_cast<const std::byte*>(byte))); }

// Prefetches consecutive lines. This is faster than reading the same lines interleaved with others.
inline void bring(std::span<const std::byte> bytes) {
  for (std::size_t at = 0; at < bytes.size(); at += kLineBytes) {
    bring_line(&bytes[at]);
  }
}

}  // namespace iog::lanes
