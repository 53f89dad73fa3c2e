#include "tools/formats/capture/pcap_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <pcap/pcap.h>
#include <vector>

#include "net/ethernet.hpp"
#include "net/ipv4.hpp"
#include "net/udp.hpp"
#include "require/require.hpp"

namespace iog::tools {
namespace {

constexpr int kSnapLength = 65'535;

// A locally administered address made of the host's IPv4 address.
net::MacAddress mac_of(std::uint32_t address) {
  return {{0x02, 0x00, static_cast<std::uint8_t>(address >> 24),
           static_cast<std::uint8_t>(address >> 16), static_cast<std::uint8_t>(address >> 8),
           static_cast<std::uint8_t>(address)}};
}

// The UDP datagram, header and payload.
std::vector<std::byte> udp_of(const CapturedDatagram& datagram) {
  std::vector<std::byte> udp(net::kUdpHeaderBytes + datagram.payload.size());
  net::write_udp(udp,
                 {.source = {datagram.source.ipv4},
                  .destination = {datagram.destination.ipv4},
                  .source_port = datagram.source.port,
                  .destination_port = datagram.destination.port},
                 datagram.payload);
  return udp;
}

// Ethernet, IPv4 and a part of the UDP datagram.
std::vector<std::byte> frame_of(const CapturedDatagram& datagram, const net::Ipv4Header& header,
                                std::span<const std::byte> part) {
  std::vector<std::byte> frame(std::max(
      net::kEthernetHeaderBytes + net::kIpv4HeaderBytes + part.size(), net::kMinFrameBytes));
  const std::span<std::byte> bytes(frame);
  net::write_ethernet_header(bytes.first<net::kEthernetHeaderBytes>(),
                             mac_of(datagram.destination.ipv4), mac_of(datagram.source.ipv4),
                             net::kEtherTypeIpv4);
  const auto packet = bytes.subspan(net::kEthernetHeaderBytes);
  net::write_ipv4_header(packet.first<net::kIpv4HeaderBytes>(), header);
  std::ranges::copy(part, packet.subspan(net::kIpv4HeaderBytes).begin());
  return frame;
}

}  // namespace

void PcapWriter::Closer::operator()(pcap* file) const { pcap_close(file); }

void PcapWriter::Closer::operator()(pcap_dumper* file) const { pcap_dump_close(file); }

PcapWriter::PcapWriter(const std::string& path)
    : path_(path), place_(path), link_(pcap_open_dead(DLT_EN10MB, kSnapLength)) {
  errno = 0;
  file_.reset(pcap_dump_open(link_.get(), place_.path().c_str()));
  if (!file_) {
    throw file_error(path, "cannot be written");
  }
}

void PcapWriter::write(const CapturedDatagram& datagram) {
  require(datagram.payload.size() <= kMaxPayloadBytes);
  const std::vector<std::byte> udp = udp_of(datagram);
  for (std::size_t at = 0; at < udp.size(); at += net::kMaxIpv4PayloadBytes) {
    const auto part =
        std::span(udp).subspan(at, std::min(udp.size() - at, net::kMaxIpv4PayloadBytes));
    const net::Ipv4Header header{.source = {datagram.source.ipv4},
                                 .destination = {datagram.destination.ipv4},
                                 .protocol = net::kProtocolUdp,
                                 .identification = identification_,
                                 .payload_bytes = part.size(),
                                 .fragment_offset = static_cast<std::uint16_t>(at),
                                 .has_more_fragments = at + part.size() < udp.size()};
    write_frame(datagram.time_us, frame_of(datagram, header, part));
  }
  ++identification_;
}

void PcapWriter::write_frame(std::uint64_t time_us, std::span<const std::byte> frame) {
  pcap_pkthdr header{};
  header.ts.tv_sec = static_cast<time_t>(time_us / 1'000'000U);
  header.ts.tv_usec = static_cast<suseconds_t>(time_us % 1'000'000U);
  header.caplen = static_cast<bpf_u_int32>(frame.size());
  header.len = header.caplen;
  errno = 0;
  // libpcap's callbacks take their file as unsigned char*.
  pcap_dump(reinterpret_cast<unsigned char*>(file_.get()), &header,
            reinterpret_cast<const unsigned char*>(frame.data()));
  // It says nothing itself. What is buffered fails later, with one of the next datagrams.
  if (std::ferror(pcap_dump_file(file_.get())) != 0) {
    throw file_error(path_, "cannot be written any more");
  }
}

void PcapWriter::finish() {
  errno = 0;
  if (pcap_dump_flush(file_.get()) != 0 || std::ferror(pcap_dump_file(file_.get())) != 0) {
    throw file_error(path_, "not written completely");
  }
  file_.reset();
  place_.finish();
}

}  // namespace iog::tools
