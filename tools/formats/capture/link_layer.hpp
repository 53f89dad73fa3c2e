// Link-layer headers around an IPv4 packet, by link type (https://www.tcpdump.org/linktypes.html).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace iog::tools {

// Of an interface that a file does not describe.
inline constexpr std::uint16_t kUnknownLink = 0xFFFF;

// Ethernet, Linux cooked ("any", versions 1 and 2), raw IP or a loopback of BSD.
[[nodiscard]] bool is_known_link(std::uint16_t link_type);

// The IPv4 packet in a frame, behind any VLAN tags; empty if the protocol is another or the link
// type is not known.
[[nodiscard]] std::span<const std::byte> ipv4_in(std::span<const std::byte> frame,
                                                 std::uint16_t link_type);

// "link type PPP, which is not read"
[[nodiscard]] std::string words_of_link(std::uint16_t link_type);

}  // namespace iog::tools
