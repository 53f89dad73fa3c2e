// What waits in a UDP port of this PC for the program that listens to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace iog::tools {

// The bytes of memory that they take, 0: everything has been read. Empty if nobody listens there.
// lines: those of /proc/net/udp (proc(5)). address: as in sockaddr_in, in the byte order of the
// wire.
[[nodiscard]] std::optional<std::size_t> bytes_waiting(const std::vector<std::string>& lines,
                                                       std::uint32_t address, std::uint16_t port);

// The same right now. Empty, too, where the system does not say.
[[nodiscard]] std::optional<std::size_t> bytes_waiting(std::uint32_t address, std::uint16_t port);

}  // namespace iog::tools
