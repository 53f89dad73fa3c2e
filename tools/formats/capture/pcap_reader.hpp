// Reads the UDP datagrams of a capture file: pcap or pcapng, Ethernet (with or without VLAN tags),
// Linux cooked, or raw IP. Fragments are joined by the target's own code, and their datagram has
// the time of the last one that came. Everything else is skipped and counted.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "net/reassembly.hpp"
#include "tools/formats/capture/datagram.hpp"

struct pcap;

namespace iog::tools {

// Packets of a capture by what became of them.
struct CaptureCounts {
  std::uint64_t datagrams = 0;
  std::uint64_t not_udp = 0;       // another protocol
  std::uint64_t cut_short = 0;     // the capture holds only the packet's beginning
  std::uint64_t fragments = 0;     // of a datagram that they do not make whole
  std::uint64_t malformed = 0;     // lengths that contradict each other
  std::uint64_t bad_checksum = 0;  // of IPv4 or UDP

  [[nodiscard]] std::uint64_t skipped() const {
    return not_udp + cut_short + fragments + malformed + bad_checksum;
  }
};

class PcapReader {
 public:
  // UsageError if the file cannot be read or its link type is another.
  explicit PcapReader(const std::string& path);

  // The next datagram; nothing at the end of the file. A file that breaks off in a packet ends
  // there, and is_cut_off() is true.
  [[nodiscard]] std::optional<CapturedDatagram> next();

  [[nodiscard]] const CaptureCounts& counts() const { return counts_; }
  [[nodiscard]] bool is_cut_off() const { return is_cut_off_; }

 private:
  struct Closer {
    void operator()(pcap* file) const;
  };

  [[nodiscard]] bool extract(std::span<const std::byte> frame, CapturedDatagram& datagram);
  // The packet itself, or the one that it completes; nothing if it is counted among the skipped.
  [[nodiscard]] std::optional<net::Ipv4Packet> whole_packet(std::span<const std::byte> packet);

  std::unique_ptr<pcap, Closer> file_;
  int link_type_ = 0;
  CaptureCounts counts_;
  std::unique_ptr<net::Reassembly> reassembly_ = std::make_unique<net::Reassembly>();
  std::uint64_t newest_us_ = 0;  // a capture may run backwards, reassembly does not
  bool is_cut_off_ = false;
};

// "12 packets skipped: 3 not UDP, ..."; empty if none was.
[[nodiscard]] std::string describe_skipped(const CaptureCounts& counts);

}  // namespace iog::tools
