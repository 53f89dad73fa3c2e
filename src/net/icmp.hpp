// ICMP echo (RFC 792), the only ICMP we speak.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::net {

inline constexpr std::size_t kIcmpHeaderBytes = 8;

enum class IcmpStatus : std::uint8_t { kEchoRequest, kOther, kBad };

// kBad: shorter than a header, or the checksum over all of `message` is wrong.
[[nodiscard]] IcmpStatus classify_icmp(std::span<const std::byte> message);

// The reply to `request`, which classify_icmp() called an echo request: the same identifier,
// sequence number and data under another type. `target` is as long as `request` and elsewhere.
void write_echo_reply(std::span<std::byte> target, std::span<const std::byte> request);

}  // namespace iog::net
