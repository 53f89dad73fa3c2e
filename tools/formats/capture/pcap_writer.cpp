#include "tools/formats/capture/pcap_writer.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <pcap/pcap.h>

#include "net/ethernet.hpp"
#include "net/ipv4.hpp"
#include "net/udp.hpp"
#include "require/require.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

constexpr int kSnapLength = 65'535;

// A locally administered address made of the host's IPv4 address.
net::MacAddress mac_of(std::uint32_t address) {
  return {{0x02, 0x00, static_cast<std::uint8_t>(address >> 24),
           static_cast<std::uint8_t>(address >> 16), static_cast<std::uint8_t>(address >> 8),
           static_cast<std::uint8_t>(address)}};
}

// Ethernet, IPv4, UDP and payload into `frame`; the bytes written.
std::size_t build_frame(const CapturedDatagram& datagram, std::uint16_t identification,
                        std::span<std::byte> frame) {
  const std::size_t udp_bytes = net::kUdpHeaderBytes + datagram.payload.size();
  net::write_ethernet_header(frame.first<net::kEthernetHeaderBytes>(),
                             mac_of(datagram.destination.ipv4), mac_of(datagram.source.ipv4),
                             net::kEtherTypeIpv4);
  const auto packet = frame.subspan(net::kEthernetHeaderBytes);
  net::write_ipv4_header(packet.first<net::kIpv4HeaderBytes>(),
                         {.source = {datagram.source.ipv4},
                          .destination = {datagram.destination.ipv4},
                          .protocol = net::kProtocolUdp,
                          .identification = identification,
                          .payload_bytes = udp_bytes});
  net::write_udp(packet.subspan(net::kIpv4HeaderBytes),
                 {.source = {datagram.source.ipv4},
                  .destination = {datagram.destination.ipv4},
                  .source_port = datagram.source.port,
                  .destination_port = datagram.destination.port},
                 datagram.payload);
  return std::max(net::kEthernetHeaderBytes + net::kIpv4HeaderBytes + udp_bytes,
                  net::kMinFrameBytes);
}

}  // namespace

void PcapWriter::Closer::operator()(pcap* file) const { pcap_close(file); }

void PcapWriter::Closer::operator()(pcap_dumper* file) const { pcap_dump_close(file); }

PcapWriter::PcapWriter(const std::string& path)
    : path_(path), link_(pcap_open_dead(DLT_EN10MB, kSnapLength)) {
  file_.reset(pcap_dump_open(link_.get(), path.c_str()));
  if (!file_) {
    throw UsageError(pcap_geterr(link_.get()));
  }
}

void PcapWriter::write(const CapturedDatagram& datagram) {
  require(datagram.payload.size() <= net::kMaxUdpPayloadBytes);
  std::array<std::byte, net::kMaxFrameBytes> frame{};
  const std::size_t bytes = build_frame(datagram, identification_++, frame);
  pcap_pkthdr header{};
  header.ts.tv_sec = static_cast<time_t>(datagram.time_us / 1'000'000U);
  header.ts.tv_usec = static_cast<suseconds_t>(datagram.time_us % 1'000'000U);
  header.caplen = static_cast<bpf_u_int32>(bytes);
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
}

}  // namespace iog::tools
