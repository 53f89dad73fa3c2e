// The number by which messages name a vehicle: the CRC-32 of its bytes (vehicle/content.hpp), so
// that two that differ in anything have different names.
#pragma once

#include <cstdint>

#include "checksum/reflected_crc32.hpp"
#include "vehicle/content.hpp"

namespace iog::vehicle {

// Of everything but `id` itself.
constexpr std::uint32_t identity_of(const Vehicle& vehicle) {
  // Bit by bit: the compiler does it.
  using Crc = checksum::ReflectedCrc32<0x04C11DB7, 1>;
  std::uint32_t state = Crc{}.state();
  write_content(vehicle, [&state](std::uint8_t byte) { state = Crc::times_x8(state ^ byte); });
  return ~state;
}

}  // namespace iog::vehicle
