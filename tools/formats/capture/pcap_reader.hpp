// Reads the UDP datagrams of a capture file: pcap or pcapng, as it is or packed by gzip or zstd;
// Ethernet (with or without VLAN tags), Linux cooked, or raw IP. Fragments are joined by the
// target's own code, and their datagram has the time of the last one that came. Everything else is
// skipped and counted.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "net/reassembly.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/capture/unpacked_file.hpp"

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

  // The next datagram; nothing at the end of the file, or where it breaks off or cannot be read
  // further.
  [[nodiscard]] std::optional<CapturedDatagram> next();

  // Where the next packet begins, for go_to(); nothing in a file that is read from its beginning
  // only: pcapng, in which a packet needs what was said before it, what is packed, and a pipe.
  [[nodiscard]] std::optional<std::uint64_t> place() const;

  // Goes on from a place() of this file. Packets that are read again are counted again, and of a
  // datagram in fragments those before that place are lost.
  void go_to(std::uint64_t place);

  [[nodiscard]] const CaptureCounts& counts() const { return counts_; }
  // "breaks off in a packet": why the file cannot be read to its end; empty if it can.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  // How much of the file has been read, 0 to 1; nothing where nobody knows its size.
  [[nodiscard]] std::optional<double> part_read() const { return bytes_.part_read(); }

 private:
  struct Closer {
    void operator()(pcap* file) const;
  };

  [[nodiscard]] bool extract(std::span<const std::byte> frame, CapturedDatagram& datagram);
  // The packet itself, or the one that it completes; nothing if it is counted among the skipped.
  [[nodiscard]] std::optional<net::Ipv4Packet> whole_packet(std::span<const std::byte> packet);

  UnpackedFile bytes_;
  std::unique_ptr<pcap, Closer> file_;  // reads the bytes
  int link_type_ = 0;
  CaptureCounts counts_;
  std::unique_ptr<net::Reassembly> reassembly_ = std::make_unique<net::Reassembly>();
  std::uint64_t newest_us_ = 0;  // a capture may run backwards, reassembly does not
  std::string trouble_;
};

// Says on stderr that the capture could not be read to its end, if so, when all has been read.
void warn_of(const std::string& path, const PcapReader& capture);

// "12 packets skipped: 3 not UDP, ..."; empty if none was.
[[nodiscard]] std::string describe_skipped(const CaptureCounts& counts);

}  // namespace iog::tools
