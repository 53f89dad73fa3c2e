// A hash of a packet, used to recognise duplicates.
//
// The hash is 64-bit FNV-1a (Fowler, Noll, Vo; RFC draft-eastlake-fnv). For each format, the hash
// covers a few dozen bytes that differ between any two packets of the same sensor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::lidar {

inline constexpr std::uint64_t kFingerprintStart = 0xCBF29CE484222325U;
inline constexpr std::uint64_t kFingerprintPrime = 0x00000100000001B3U;

constexpr std::uint64_t fingerprint(std::span<const std::byte> bytes,
                                    std::uint64_t start = kFingerprintStart) {
  std::uint64_t hash = start;
  for (const std::byte byte : bytes) {
    hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * kFingerprintPrime;
  }
  return hash;
}

}  // namespace iog::lidar
