#include "tools/vehicles/network_words.hpp"

#include "tools/info/capture_census.hpp"
#include "tools/receive/frame_record.hpp"

namespace iog::tools {

std::string words_of(const net::MacAddress& mac) {
  std::string words;
  for (const std::uint8_t octet : mac.octets) {
    words.append(words.empty() ? "" : ":").append(hex(octet), 6);
  }
  return words;
}

std::string network_line(const net::Config& network) {
  return words_of(network.mac) + " " + dotted(network.address.value) + " " +
         std::to_string(network.prefix_bits) + " " + dotted(network.peer.value) + " " +
         std::to_string(network.peer_port) + " " + std::to_string(network.source_port);
}

}  // namespace iog::tools
