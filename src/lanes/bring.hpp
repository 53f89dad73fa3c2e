// Prefetches cache lines that will be needed soon. These functions use asm statements without
// outputs, which the compiler never removes.
#pragma once

#include <cstddef>
#include <span>

namespace iog::lanes {

inline constexpr std::size_t kLineBytes = 32;

// Prefetches the cache line of a byte by reading the byte. Two such reads can be in progress at the
// same time. In contrast, stores that miss the cache wait for each other.
inline void bring_line(const void* byte) { asm("" : : "r"(*static_cast<const std::byte*>(byte))); }

// Prefetches consecutive cache lines. Reading consecutive lines is faster than alternating between
// them and other lines.
inline void bring(std::span<const std::byte> bytes) {
  for (std::size_t at = 0; at < bytes.size(); at += kLineBytes) {
    bring_line(&bytes[at]);
  }
}

// Prefetches the cache line that lies `bytes_ahead` bytes after an address (PLD). The function does
// not wait for the line. The line may lie outside the object.
inline void preload(const void* address, std::size_t bytes_ahead = 0) {
  __builtin_prefetch(static_cast<const std::byte*>(address) + bytes_ahead);
}

}  // namespace iog::lanes
