// What stands in a capture that no network recorded, because its packets are simulated, converted
// or fused on this PC.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "tools/formats/capture/datagram.hpp"

namespace iog::tools {

// 2024-05-01 12:00:00 UTC: every drive begins then, so that its bytes do not depend on the day.
inline constexpr std::uint64_t kDriveStartUs = 1'714'564'800'000'000U;

inline constexpr std::uint32_t kTargetIpv4 = 0x0A00020F;   // 10.0.2.15
inline constexpr std::uint32_t kUnnamedIpv4 = 0x0A000264;  // of a sensor whose car names no address

// Where a target's stream comes from and goes to: as with the reference board
// (board/common/main.cpp).
inline constexpr Endpoint kStreamSource{.ipv4 = kTargetIpv4, .port = 15001};
inline constexpr Endpoint kStreamDestination{.ipv4 = 0x0A000202, .port = 15000};

// A message of it.
[[nodiscard]] inline CapturedDatagram datagram_of_stream(std::uint64_t time_us,
                                                         std::span<const std::byte> message) {
  return {.time_us = time_us,
          .source = kStreamSource,
          .destination = kStreamDestination,
          .payload = {message.begin(), message.end()}};
}

}  // namespace iog::tools
