// NTP64 time: seconds since 1900-01-01 in the high 32 bits, fractions of 2^-32 s in the low ones.
#pragma once

#include <cstdint>

namespace iog::tools {

// Seconds from 1900-01-01 to 1970-01-01 (RFC 868).
inline constexpr std::uint64_t kNtpOfUnixEpoch = 2'208'988'800U;
inline constexpr std::uint64_t kMicrosecondsPerSecond = 1'000'000U;

constexpr std::uint64_t ntp_of_unix_us(std::uint64_t unix_us) {
  const std::uint64_t seconds = unix_us / kMicrosecondsPerSecond + kNtpOfUnixEpoch;
  const std::uint64_t fraction =
      ((unix_us % kMicrosecondsPerSecond) << 32) / kMicrosecondsPerSecond;
  return seconds << 32 | fraction;
}

// A scanner without a clock counts from its power-on; that is time since the Unix epoch here.
constexpr std::uint64_t unix_us_of_ntp(std::uint64_t ntp) {
  const std::uint64_t seconds = ntp >> 32;
  const std::uint64_t micros = ((ntp & 0xFFFFFFFFU) * kMicrosecondsPerSecond) >> 32;
  const std::uint64_t since_epoch =
      seconds >= kNtpOfUnixEpoch ? seconds - kNtpOfUnixEpoch : seconds;
  return since_epoch * kMicrosecondsPerSecond + micros;
}

}  // namespace iog::tools
