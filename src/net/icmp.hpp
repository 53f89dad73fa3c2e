// ICMP echo (RFC 792). We answer no other ICMP messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::net {

inline constexpr std::size_t kIcmpHeaderBytes = 8;

enum class IcmpStatus : std::uint8_t { kEchoRequest, kOther, kBad };

// kBad: the message is shorter than a header, or the checksum over all of `message` is wrong.
[[nodiscard]] IcmpStatus classify_icmp(std::span<const std::byte> message);

// Writes the reply to `request`, which classify_icmp() classified as an echo request. Identifier,
// sequence number and data are copied. `target` must be as long as `request` and must not overlap
// it.
void write_echo_reply(std::span<std::byte> target, std::span<const std::byte> request);

}  // namespace iog::net
