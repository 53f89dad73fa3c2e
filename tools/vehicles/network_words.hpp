// Addresses and a car's network in words.
#pragma once

#include <cstdint>
#include <string>

#include "net/config.hpp"

namespace iog::tools {

// "10.0.2.15"
[[nodiscard]] std::string dotted(std::uint32_t ipv4);

// "02:69:6f:67:00:01"
[[nodiscard]] std::string words_of(const net::MacAddress& mac);

// For scripts: MAC, address, bits of the prefix, peer, its port, and the port that messages come
// from, with a blank between two.
[[nodiscard]] std::string network_line(const net::Config& network);

}  // namespace iog::tools
