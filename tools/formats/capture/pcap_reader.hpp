// Reads the UDP datagrams of a capture file: pcap or pcapng, as it is or packed by gzip or zstd.
// Fragments are joined by the target's own code, and their datagram has the time of the last one
// that came. Outgoing packets, captured before the network card filled in checksums and lengths,
// are accepted. Everything else is skipped and counted.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/reassembly.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/capture/packet_file.hpp"

namespace iog::tools {

// Packets of a capture by what became of them.
struct CaptureCounts {
  std::uint64_t datagrams = 0;
  std::uint64_t not_udp = 0;                           // another protocol
  std::map<std::uint16_t, std::uint64_t> other_links;  // of interfaces of a link that is not read
  std::uint64_t cut_short = 0;        // the capture holds only the packet's beginning
  std::uint64_t fragments = 0;        // of a datagram that they do not make whole
  std::uint64_t first_fragments = 0;  // of these the first ones of their datagrams
  std::uint64_t malformed = 0;        // lengths that contradict each other
  std::uint64_t bad_checksum = 0;     // of IPv4 or UDP

  [[nodiscard]] std::uint64_t skipped() const;
};

class PcapReader {
 public:
  // Where the next packet begins, and the clock up to there.
  struct Place {
    std::uint64_t at = 0;
    SteadyTime clock;
  };

  // UsageError if the file cannot be read or its link type is another.
  explicit PcapReader(const std::string& path);

  // The next datagram; nothing at the end of the file, or where it breaks off or cannot be read
  // further. A clock that was set back while it was recorded shows in counts only.
  [[nodiscard]] std::optional<CapturedDatagram> next();

  // For go_to(); nothing in a file that is read from its beginning only.
  [[nodiscard]] std::optional<Place> place() const;

  // Goes on from a place() of this file. Packets that are read again are counted again, and of a
  // datagram in fragments those before that place are lost.
  void go_to(const Place& place);

  [[nodiscard]] const CaptureCounts& counts() const { return counts_; }
  // The clock's steps, which times do not show, and a wrong unit; empty if there are none.
  [[nodiscard]] std::string clock_words() const;
  // "breaks off in a packet": why the file cannot be read to its end; empty if it can.
  [[nodiscard]] const std::string& trouble() const { return file_.trouble(); }
  // How much of the file has been read, 0 to 1; nothing where nobody knows its size.
  [[nodiscard]] std::optional<double> part_read() const { return file_.part_read(); }

 private:
  using Bytes = std::span<const std::byte>;

  [[nodiscard]] bool extract(const CapturedPacket& packet, CapturedDatagram& datagram);
  // The packet itself, or the one that it completes; nothing if it is counted among the skipped.
  [[nodiscard]] std::optional<net::Ipv4Packet> whole_packet(Bytes packet);
  [[nodiscard]] Bytes filled_in(Bytes packet);

  PacketFile file_;
  SteadyTime clock_;
  CaptureCounts counts_;
  std::unique_ptr<net::Reassembly> reassembly_ = std::make_unique<net::Reassembly>();
  std::uint64_t newest_us_ = 0;  // a capture may run backwards, reassembly does not
  std::vector<std::byte> filled_in_;
};

// Reports on stderr, when all has been read, whether the capture breaks off, which packets were
// skipped, and the steps of its clock.
void warn_of(const std::string& path, const PcapReader& capture);

// "12 packets skipped: 3 not UDP, ..."; empty if none was.
[[nodiscard]] std::string describe_skipped(const CaptureCounts& counts);

}  // namespace iog::tools
