#include "tools/formats/capture/link_layer.hpp"

#include <algorithm>
#include <array>
#include <pcap/pcap.h>

#include "net/ethernet.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

struct Link {
  std::uint16_t type;
  std::size_t header_bytes;
  // Where its EtherType is. A tag, which has the next type, stands where the packet would.
  std::size_t type_at;
};

constexpr std::size_t kNoType = 0xFF;
constexpr std::array<Link, 9> kLinks{{{1, 14, 12},      // Ethernet
                                      {113, 16, 14},    // LINUX_SLL
                                      {276, 20, 0},     // LINUX_SLL2
                                      {0, 4, kNoType},  // NULL, and the same on the network: LOOP
                                      {108, 4, kNoType},
                                      {101, 0, kNoType},  // RAW; 12 and 14 in files of old
                                      {12, 0, kNoType},
                                      {14, 0, kNoType},
                                      {228, 0, kNoType}}};  // IPV4

constexpr std::uint16_t kOldServiceVlan = 0x9100;  // before IEEE 802.1ad
constexpr std::size_t kTagBytes = 4;

bool is_tag(std::uint16_t type) {
  return type == net::kEtherTypeVlan || type == net::kEtherTypeServiceVlan ||
         type == kOldServiceVlan;
}

std::uint16_t type_at(std::span<const std::byte> frame, std::size_t place) {
  return place + 2 <= frame.size() ? wire::load_be16(frame.subspan(place).first<2>())
                                   : std::uint16_t{0};
}

const Link* link_of(std::uint16_t type) {
  const auto* const found = std::ranges::find(kLinks, type, &Link::type);
  return found == kLinks.end() ? nullptr : found;
}

}  // namespace

bool is_known_link(std::uint16_t link_type) { return link_of(link_type) != nullptr; }

std::span<const std::byte> ipv4_in(std::span<const std::byte> frame, std::uint16_t link_type) {
  constexpr unsigned kVersion = 4;
  const Link* const link = link_of(link_type);
  if (link == nullptr) {
    return {};
  }
  std::size_t begin = link->header_bytes;
  std::uint16_t type = net::kEtherTypeIpv4;
  if (link->type_at != kNoType) {
    type = type_at(frame, link->type_at);
    for (; is_tag(type); begin += kTagBytes) {
      type = type_at(frame, begin + 2);
    }
  }
  const bool is_there = type == net::kEtherTypeIpv4 && begin < frame.size() &&
                        std::to_integer<unsigned>(frame[begin]) >> 4 == kVersion;
  return is_there ? frame.subspan(begin) : std::span<const std::byte>{};
}

std::string words_of_link(std::uint16_t link_type) {
  if (link_type == kUnknownLink) {
    return "an interface that the file does not describe";
  }
  const char* const name = pcap_datalink_val_to_name(link_type);
  return "link type " + (name != nullptr ? name : std::to_string(link_type)) +
         ", which is not read";
}

}  // namespace iog::tools
