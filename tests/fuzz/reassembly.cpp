// Reassembly on a series of pieces of a few datagrams. What is completed is compared with all that
// was said of it: each byte was in a piece, and at that place.
#include "net/reassembly.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "law.hpp"

namespace iog::fuzz {
namespace {

std::uint32_t total(const net::FragmentCounters& counters) {
  return counters.joined + counters.completed + counters.duplicates + counters.overlaps +
         counters.bad + counters.refused;
}

bool was_said(const std::vector<net::Ipv4Packet>& pieces, const net::Ipv4Packet& whole,
              std::size_t at) {
  return std::ranges::any_of(pieces, [&](const net::Ipv4Packet& piece) {
    return piece.source == whole.source && piece.identification == whole.identification &&
           piece.fragment_offset <= at && at - piece.fragment_offset < piece.payload.size() &&
           piece.payload[at - piece.fragment_offset] == whole.payload[at];
  });
}

}  // namespace

void check(std::span<const std::byte> input) {
  wire::ByteReader in(input);
  const auto reassembly = std::make_unique<net::Reassembly>();
  net::FragmentCounters counters;
  std::vector<net::Ipv4Packet> pieces;
  std::uint64_t now_us = 0;
  while (in.remaining() > 0 && pieces.size() < 200) {
    const std::uint8_t choice = in.u8();
    now_us += std::uint64_t{in.u8()} * 500;
    const std::uint32_t offset = in.u16_be() & 0x1FFFU;
    const auto payload = next_piece(in);
    pieces.push_back({.source = {0x0A000265U + (choice & 1U)},
                      .protocol = net::kProtocolUdp,
                      .identification = static_cast<std::uint16_t>(choice >> 1 & 7U),
                      .fragment_offset = 8 * offset,
                      .has_more_fragments = (choice & 0x80U) != 0,
                      .payload = payload});
    const net::Reassembly::Result result = reassembly->add(pieces.back(), now_us, counters);
    law(total(counters) == pieces.size(), "each piece is counted once");
    law((result.fate == net::Reassembly::Fate::kCompleted) == !result.packet.payload.empty(),
        "what is complete is not empty");
    for (std::size_t at = 0; at < result.packet.payload.size(); ++at) {
      law(was_said(pieces, result.packet, at), "each byte was said");
    }
  }
}

}  // namespace iog::fuzz
