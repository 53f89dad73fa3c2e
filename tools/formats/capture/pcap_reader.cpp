#include "tools/formats/capture/pcap_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <pcap/pcap.h>
#include <string_view>
#include <utility>

#include "net/ethernet.hpp"
#include "net/ipv4.hpp"
#include "net/udp.hpp"
#include "tools/formats/capture/file_hint.hpp"
#include "tools/program/exit_status.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kCookedHeaderBytes = 16;   // LINKTYPE_LINUX_SLL: protocol in its last two
constexpr std::size_t kCooked2HeaderBytes = 20;  // LINKTYPE_LINUX_SLL2: protocol in its first two
constexpr std::size_t kMaxVlanTags = 2;

// The IPv4 packet in a frame; empty if there is another protocol in it.
std::span<const std::byte> ipv4_in_ethernet(std::span<const std::byte> frame) {
  wire::ByteReader reader(frame);
  reader.skip(12);
  std::uint16_t type = reader.u16_be();
  for (std::size_t tag = 0; tag < kMaxVlanTags; ++tag) {
    if (type == net::kEtherTypeVlan || type == net::kEtherTypeServiceVlan) {
      reader.skip(2);
      type = reader.u16_be();
    }
  }
  return type == net::kEtherTypeIpv4 ? reader.bytes(reader.remaining())
                                     : std::span<const std::byte>{};
}

std::span<const std::byte> ipv4_in_cooked(std::span<const std::byte> frame, std::size_t header,
                                          std::size_t type_at) {
  wire::ByteReader reader(frame);
  reader.skip(type_at);
  const std::uint16_t type = reader.u16_be();
  reader.skip(header - type_at - 2);
  return type == net::kEtherTypeIpv4 ? reader.bytes(reader.remaining())
                                     : std::span<const std::byte>{};
}

std::span<const std::byte> ipv4_in(std::span<const std::byte> frame, int link_type) {
  switch (link_type) {
    case DLT_EN10MB:
      return ipv4_in_ethernet(frame);
    case DLT_LINUX_SLL:
      return ipv4_in_cooked(frame, kCookedHeaderBytes, kCookedHeaderBytes - 2);
    case DLT_LINUX_SLL2:
      return ipv4_in_cooked(frame, kCooked2HeaderBytes, 0);
    default:  // raw IP; version 6 is told apart by parse_ipv4
      return frame;
  }
}

bool is_known_link(int link_type) {
  return link_type == DLT_EN10MB || link_type == DLT_LINUX_SLL || link_type == DLT_LINUX_SLL2 ||
         link_type == DLT_RAW || link_type == DLT_IPV4;
}

// What libpcap reads from. The bytes outlive it.
std::FILE* c_file_of(UnpackedFile& bytes) {
  const auto read = [](void* from, char* to, std::size_t count) {
    return static_cast<ssize_t>(
        static_cast<UnpackedFile*>(from)->read(std::as_writable_bytes(std::span(to, count))));
  };
  const auto seek = [](void* from, off64_t* to, int whence) {
    auto& file = *static_cast<UnpackedFile*>(from);
    if (whence == SEEK_CUR && *to == 0) {
      *to = static_cast<off64_t>(file.place());
      return file.can_go() ? 0 : -1;
    }
    return whence == SEEK_SET && file.go_to(static_cast<std::uint64_t>(*to)) ? 0 : -1;
  };
  std::FILE* const file =
      fopencookie(&bytes, "rb", {.read = read, .write = nullptr, .seek = seek, .close = nullptr});
  if (file == nullptr) {
    throw UsageError("no memory to read a capture");
  }
  return file;
}

std::string why_no_capture(const UnpackedFile& bytes, const std::string& reason) {
  if (!bytes.trouble().empty()) {
    return bytes.trouble();
  }
  const std::string hint = hint_of(bytes.begin());
  if (hint.empty()) {
    return reason + "; captures are pcap or pcapng files, as they are or packed by gzip or zstd";
  }
  const std::string packer = bytes.packer();
  return (packer.empty() ? "" : "packed by " + packer + ", which is unpacked for captures only: ") +
         hint;
}

}  // namespace

void PcapReader::Closer::operator()(pcap* file) const { pcap_close(file); }

PcapReader::PcapReader(const std::string& path) : bytes_(path) {
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  std::FILE* const bytes = c_file_of(bytes_);
  file_.reset(pcap_fopen_offline(bytes, error.data()));
  if (!file_) {
    static_cast<void>(std::fclose(bytes));
    throw UsageError(path + ": " + why_no_capture(bytes_, error.data()));
  }
  link_type_ = pcap_datalink(file_.get());
  if (!is_known_link(link_type_)) {
    const char* const name = pcap_datalink_val_to_name(link_type_);
    throw UsageError(path + ": link type " + (name != nullptr ? name : std::to_string(link_type_)) +
                     "; record on Ethernet, or convert the capture to it");
  }
}

std::optional<std::uint64_t> PcapReader::place() const {
  const bool is_pcapng = !bytes_.begin().empty() && bytes_.begin()[0] == std::byte{0x0A};
  const off64_t place = is_pcapng || !bytes_.can_go() ? -1 : ftello64(pcap_file(file_.get()));
  return place < 0 ? std::nullopt : std::optional(static_cast<std::uint64_t>(place));
}

void PcapReader::go_to(std::uint64_t place) {
  if (fseeko64(pcap_file(file_.get()), static_cast<off64_t>(place), SEEK_SET) != 0) {
    throw UsageError("a capture cannot be read from another place");
  }
  reassembly_ = std::make_unique<net::Reassembly>();
  newest_us_ = 0;
  trouble_.clear();
}

std::optional<CapturedDatagram> PcapReader::next() {
  pcap_pkthdr* header = nullptr;
  const unsigned char* bytes = nullptr;
  int status = 0;
  while ((status = pcap_next_ex(file_.get(), &header, &bytes)) == 1) {
    if (header->caplen < header->len) {
      ++counts_.cut_short;
      continue;
    }
    CapturedDatagram datagram;
    datagram.time_us = static_cast<std::uint64_t>(header->ts.tv_sec) * 1'000'000U +
                       static_cast<std::uint64_t>(header->ts.tv_usec);
    newest_us_ = std::max(newest_us_, datagram.time_us);
    if (extract(std::as_bytes(std::span(bytes, header->caplen)), datagram)) {
      ++counts_.datagrams;
      return datagram;
    }
  }
  trouble_ = bytes_.trouble();
  if (status == PCAP_ERROR && trouble_.empty()) {
    const std::string_view reason = pcap_geterr(file_.get());
    trouble_ = reason.starts_with("truncated") ? "breaks off in a packet"
                                               : "cannot be read further: " + std::string(reason);
  }
  return std::nullopt;
}

std::optional<net::Ipv4Packet> PcapReader::whole_packet(std::span<const std::byte> packet) {
  const net::Ipv4Result ip = net::parse_ipv4(packet);
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
  net::FragmentCounters ignored;
  const net::Reassembly::Result result = reassembly_->add(ip.packet, newest_us_, ignored);
  if (result.fate != net::Reassembly::Fate::kCompleted) {
    return std::nullopt;
  }
  counts_.fragments -= result.pieces;
  return result.packet;
}

bool PcapReader::extract(std::span<const std::byte> frame, CapturedDatagram& datagram) {
  const std::span<const std::byte> packet = ipv4_in(frame, link_type_);
  if (packet.empty() || std::to_integer<unsigned>(packet[0]) >> 4 != 4) {
    ++counts_.not_udp;
    return false;
  }
  const std::optional<net::Ipv4Packet> ip = whole_packet(packet);
  if (!ip) {
    return false;
  }
  const net::UdpResult udp = net::parse_udp(*ip);
  if (udp.status != net::UdpStatus::kOk) {
    ++(udp.status == net::UdpStatus::kBadChecksum ? counts_.bad_checksum : counts_.malformed);
    return false;
  }
  datagram.source = {ip->source.value, udp.datagram.source_port};
  datagram.destination = {ip->destination.value, udp.datagram.destination_port};
  datagram.payload.assign(udp.datagram.payload.begin(), udp.datagram.payload.end());
  return true;
}

void warn_of(const std::string& path, const PcapReader& capture) {
  if (!capture.trouble().empty()) {
    std::cerr << "iog: " << path << ": " << capture.trouble() << "; used as far as it goes\n";
  }
}

std::string describe_skipped(const CaptureCounts& counts) {
  const std::array<std::pair<std::uint64_t, const char*>, 5> causes{{
      {counts.not_udp, "not UDP over IPv4"},
      {counts.cut_short, "cut short by the capture"},
      {counts.fragments, "fragments"},
      {counts.malformed, "malformed"},
      {counts.bad_checksum, "with a wrong checksum"},
  }};
  std::string text;
  for (const auto& [count, cause] : causes) {
    if (count > 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + cause;
    }
  }
  return text.empty() ? text : std::to_string(counts.skipped()) + " packets skipped: " + text;
}

}  // namespace iog::tools
