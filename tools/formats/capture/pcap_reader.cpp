#include "tools/formats/capture/pcap_reader.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <numeric>
#include <utility>

#include "net/checksum.hpp"
#include "net/ipv4.hpp"
#include "net/udp.hpp"
#include "tools/formats/capture/link_layer.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/table.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kTotalLengthAt = 2;
constexpr std::size_t kIpv4ChecksumAt = 10;
constexpr std::size_t kUdpChecksumAt = 6;

std::uint16_t half_at(std::span<const std::byte> bytes, std::size_t at) {
  return wire::load_be16(bytes.subspan(at).first<2>());
}

// Whether the checksum is still to be computed by the network card, which finds the sum of the
// pseudo header (RFC 768) in its place, folded and not complemented: Linux's CHECKSUM_PARTIAL.
bool is_left_to_card(const net::Ipv4Packet& ip) {
  net::Checksum pseudo_header;
  pseudo_header.add_u32(ip.source.value);
  pseudo_header.add_u32(ip.destination.value);
  pseudo_header.add_u16(ip.protocol);
  pseudo_header.add_u16(half_at(ip.payload, 4));
  return half_at(ip.payload, kUdpChecksumAt) == static_cast<std::uint16_t>(~pseudo_header.value());
}

}  // namespace

std::uint64_t CaptureCounts::skipped() const {
  return std::accumulate(
      other_links.begin(), other_links.end(),
      not_udp + cut_short + fragments + malformed + bad_checksum,
      [](std::uint64_t sum, const auto& link_and_count) { return sum + link_and_count.second; });
}

PcapReader::PcapReader(const std::string& path) : file_(path) {
  const std::optional<std::uint16_t> link = file_.link_type();
  if (link && !is_known_link(*link)) {
    throw UsageError(path + ": " + words_of_link(*link) +
                     "; record on Ethernet, or convert the capture to it");
  }
}

std::optional<PcapReader::Place> PcapReader::place() const {
  const std::optional<std::uint64_t> at = file_.place();
  return at ? std::optional(Place{.at = *at, .clock = clock_}) : std::nullopt;
}

void PcapReader::go_to(const Place& place) {
  file_.go_to(place.at);
  clock_ = place.clock;
  reassembly_ = std::make_unique<net::Reassembly>();
  newest_us_ = 0;
}

std::optional<CapturedDatagram> PcapReader::next() {
  while (const std::optional<CapturedPacket> packet = file_.next()) {
    if (!is_known_link(packet->link_type)) {
      ++counts_.other_links[packet->link_type];
      continue;
    }
    CapturedDatagram datagram;
    datagram.time_us = clock_.of(packet->time_us);
    newest_us_ = std::max(newest_us_, datagram.time_us);
    if (packet->is_cut) {
      ++counts_.cut_short;
    } else if (extract(*packet, datagram)) {
      ++counts_.datagrams;
      return datagram;
    }
  }
  return std::nullopt;
}

std::string PcapReader::clock_words() const {
  std::vector<std::string> all{file_.unit_words(), clock_.words()};
  std::erase(all, "");
  return joined(all, "; ");
}

// The packet, with the fields that the network card would fill in: a checksum of 0, and a length of
// 0 if the card splits the packet.
PcapReader::Bytes PcapReader::filled_in(Bytes packet) {
  if (packet.size() < net::kIpv4HeaderBytes) {
    return packet;
  }
  const bool has_length = half_at(packet, kTotalLengthAt) != 0;
  const bool has_checksum = half_at(packet, kIpv4ChecksumAt) != 0;
  const std::size_t header_bytes = (std::to_integer<std::size_t>(packet[0]) & 15U) * 4;
  const bool is_sound = header_bytes >= net::kIpv4HeaderBytes && header_bytes <= packet.size() &&
                        (!has_checksum || net::internet_checksum(packet.first(header_bytes)) == 0);
  if ((has_length && has_checksum) || !is_sound) {
    return packet;
  }
  filled_in_.assign(packet.begin(), packet.end());
  const std::span header = std::span(filled_in_).first(header_bytes);
  if (!has_length) {
    wire::store_be16(header.subspan<kTotalLengthAt, 2>(),
                     static_cast<std::uint16_t>(std::min<std::size_t>(packet.size(), 0xFFFF)));
  }
  const auto checksum = header.subspan<kIpv4ChecksumAt, 2>();
  wire::store_be16(checksum, 0);
  wire::store_be16(checksum, net::internet_checksum(header));
  return filled_in_;
}

std::optional<net::Ipv4Packet> PcapReader::whole_packet(Bytes packet) {
  const net::Ipv4Result ip = net::parse_ipv4(filled_in(packet));
  const bool is_sound =
      ip.status == net::Ipv4Status::kOk || ip.status == net::Ipv4Status::kFragment;
  if (!is_sound) {
    const bool is_changed = ip.status == net::Ipv4Status::kBadChecksum;
    ++(is_changed ? counts_.bad_checksum : counts_.malformed);
    return std::nullopt;
  }
  if (ip.packet.protocol != net::kProtocolUdp) {
    ++counts_.not_udp;
    return std::nullopt;
  }
  if (ip.status == net::Ipv4Status::kOk) {
    return ip.packet;
  }
  ++counts_.fragments;
  counts_.first_fragments += ip.packet.fragment_offset == 0 ? 1U : 0U;
  net::FragmentCounters ignored;
  const net::Reassembly::Result result = reassembly_->add(ip.packet, newest_us_, ignored);
  if (result.fate != net::Reassembly::Fate::kCompleted) {
    return std::nullopt;
  }
  counts_.fragments -= result.pieces;
  --counts_.first_fragments;
  return result.packet;
}

bool PcapReader::extract(const CapturedPacket& packet, CapturedDatagram& datagram) {
  const Bytes ipv4 = ipv4_in(packet.bytes, packet.link_type);
  if (ipv4.empty()) {
    ++counts_.not_udp;
    return false;
  }
  const std::optional<net::Ipv4Packet> ip = whole_packet(ipv4);
  if (!ip) {
    return false;
  }
  const net::UdpResult udp = net::parse_udp(*ip);
  const bool is_changed = udp.status == net::UdpStatus::kBadChecksum;
  if (udp.status == net::UdpStatus::kBadLength || (is_changed && !is_left_to_card(*ip))) {
    ++(is_changed ? counts_.bad_checksum : counts_.malformed);
    return false;
  }
  const Bytes bytes = ip->payload.first(half_at(ip->payload, 4));
  datagram.source = {ip->source.value, half_at(bytes, 0)};
  datagram.destination = {ip->destination.value, half_at(bytes, 2)};
  datagram.payload.assign(bytes.begin() + net::kUdpHeaderBytes, bytes.end());
  return true;
}

void warn_of(const std::string& path, const PcapReader& capture) {
  if (!capture.trouble().empty()) {
    std::cerr << "iog: " << path << ": " << capture.trouble() << "; used as far as it goes\n";
  }
  if (capture.counts().skipped() > capture.counts().not_udp) {
    std::cerr << "iog: " << path << ": " << describe_skipped(capture.counts()) << '\n';
  }
  if (const std::string words = capture.clock_words(); !words.empty()) {
    std::cerr << "iog: " << path << ": " << words << '\n';
  }
}

namespace {

// A filter such as `udp port 7502` passes first fragments only, which alone have the ports.
const char* words_of_fragments(const CaptureCounts& counts) {
  return counts.first_fragments == counts.fragments
             ? "first fragments without the others of their datagrams (a filter by port passes no "
               "others: record with `host ADDRESS`)"
         : counts.first_fragments == 0
             ? "fragments without the first ones of their datagrams (record all packets of "
               "`host ADDRESS`)"
             : "fragments of incomplete datagrams";
}

}  // namespace

std::string describe_skipped(const CaptureCounts& counts) {
  const std::array<std::pair<std::uint64_t, const char*>, 5> causes{{
      {counts.not_udp, "not UDP over IPv4"},
      {counts.cut_short, "cut short by the capture (record whole packets: `tcpdump -s 0`)"},
      {counts.fragments, words_of_fragments(counts)},
      {counts.malformed, "malformed"},
      {counts.bad_checksum, "with a wrong checksum"},
  }};
  std::string text;
  for (const auto& [count, cause] : causes) {
    if (count > 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + cause;
    }
  }
  for (const auto& [link, count] : counts.other_links) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " of " + words_of_link(link);
  }
  return text.empty() ? text : counted(counts.skipped(), "packet|packets skipped: ") + text;
}

}  // namespace iog::tools
