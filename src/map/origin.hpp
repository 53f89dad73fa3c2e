// A hash that identifies the origin of a map. Two maps, or a map and a pose, refer to the same
// plane if their hashes are equal.
#pragma once

#include <cstdint>

namespace iog::map {

// Returns the 64-bit FNV-1a hash (Fowler, Noll, Vo) of latitude and longitude in units of 1e-9
// degrees. The hash covers 16 bytes in big-endian byte order, with the latitude first.
[[nodiscard]] constexpr std::uint64_t origin_name(std::int64_t latitude, std::int64_t longitude) {
  constexpr std::uint64_t kOffsetBasis = 0xCBF29CE484222325;
  constexpr std::uint64_t kPrime = 0x00000100000001B3;
  std::uint64_t name = kOffsetBasis;
  for (const std::int64_t angle : {latitude, longitude}) {
    for (int shift = 56; shift >= 0; shift -= 8) {
      name = (name ^ (static_cast<std::uint64_t>(angle) >> shift & 0xFF)) * kPrime;
    }
  }
  return name;
}

}  // namespace iog::map
