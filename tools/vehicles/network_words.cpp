#include "tools/vehicles/network_words.hpp"

#include "tools/program/hexadecimal.hpp"

namespace iog::tools {

std::string dotted(std::uint32_t ipv4) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    text += std::to_string(ipv4 >> shift & 0xFF) + (shift > 0 ? "." : "");
  }
  return text;
}

std::string words_of(const net::MacAddress& mac) {
  std::string words;
  for (const std::uint8_t octet : mac.octets) {
    words.append(words.empty() ? "" : ":").append(hex(octet, 2));
  }
  return words;
}

std::string network_line(const net::Config& network) {
  return words_of(network.mac) + " " + dotted(network.address.value) + " " +
         std::to_string(network.prefix_bits) + " " + dotted(network.peer.value) + " " +
         std::to_string(network.peer_port) + " " + std::to_string(network.source_port);
}

}  // namespace iog::tools
