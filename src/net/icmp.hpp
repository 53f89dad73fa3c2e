// ICMP echo (RFC 792). Other ICMP messages are not answered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::net {

inline constexpr std::size_t kIcmpHeaderBytes = 8;

enum class IcmpStatus : std::uint8_t { kEchoRequest, kOther, kBad };

// Returns kBad if the message is shorter than a header, or if the checksum over the entire
// `message` is wrong.
[[nodiscard]] IcmpStatus classify_icmp(std::span<const std::byte> message);

// Writes the reply to `request`. classify_icmp() must have returned kEchoRequest for `request`.
// Copies the identifier, the sequence number and the data. `target` must be as long as `request`
// and must not overlap it.
void write_echo_reply(std::span<std::byte> target, std::span<const std::byte> request);

}  // namespace iog::net
