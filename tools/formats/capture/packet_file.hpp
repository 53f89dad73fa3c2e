// The packets of a capture file, pcap (draft-ietf-opsawg-pcap) or pcapng
// (draft-ietf-opsawg-pcapng), of either byte order, as it is or packed by gzip or zstd. Each
// interface of a pcapng has its own link type, snapshot length and time unit, and each section its
// own interfaces; libpcap rejects files in which they differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/formats/capture/unpacked_file.hpp"

namespace iog::tools {

struct CapturedPacket {
  std::uint16_t link_type = 0;
  std::uint64_t time_us = 0;  // since 1970-01-01 UTC
  bool is_cut = false;        // the capture holds only its beginning
  std::span<const std::byte> bytes{};
};

class PacketFile {
 public:
  // UsageError if the file cannot be read or is no capture.
  explicit PacketFile(const std::string& path);

  // The next packet, whose bytes stay until the next call; nothing at the end of the file, or where
  // it breaks off or cannot be read further.
  [[nodiscard]] std::optional<CapturedPacket> next();

  // The link type of all packets; nothing of a pcapng.
  [[nodiscard]] std::optional<std::uint16_t> link_type() const;

  // Where the next packet begins, for go_to(); nothing if the file can only be read from its
  // beginning: pcapng, where a packet needs the blocks before it, packed files, and pipes.
  [[nodiscard]] std::optional<std::uint64_t> place() const;

  // Goes on from a place() of this file.
  void go_to(std::uint64_t place);

  // "breaks off in a packet": why the file cannot be read to its end; empty if it can.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  // That times are of another unit than a pcap's header says; empty if they are of that. Complete
  // when all has been read.
  [[nodiscard]] std::string unit_words() const;
  [[nodiscard]] std::optional<double> part_read() const { return bytes_.part_read(); }

 private:
  struct Interface {
    std::uint16_t link_type = 0;
    std::uint32_t most_bytes = 0;  // that are kept of a packet; 0: all
    std::uint8_t unit = 6;         // of time: 10^-6 s; with the bit 0x80 powers of 2
    std::int64_t begin_s = 0;      // what times count from, since 1970
  };
  using Bytes = std::span<const std::byte>;

  [[nodiscard]] std::optional<CapturedPacket> next_of_pcap();
  // Of a pcap's packet. More than a million in a second can only be nanoseconds.
  [[nodiscard]] std::uint64_t time_of(std::uint32_t seconds, std::uint32_t fraction);
  [[nodiscard]] std::optional<CapturedPacket> next_of_pcapng();
  // A block's content, of whatever type; nothing at the end.
  [[nodiscard]] std::optional<Bytes> next_block(std::uint32_t& type);
  [[nodiscard]] std::optional<CapturedPacket> packet_in(std::uint32_t type, Bytes block);
  void add_interface(Bytes block);
  [[nodiscard]] static std::uint64_t time_of(const Interface& its, std::uint64_t units);

  // Fills `to` with the next bytes of the file, or says why not; false at its end, too.
  [[nodiscard]] bool read(std::span<std::byte> to, bool may_end = false);
  [[nodiscard]] std::uint16_t half(Bytes bytes, std::size_t at) const;
  [[nodiscard]] std::uint32_t word(Bytes bytes, std::size_t at) const;

  UnpackedFile bytes_;
  bool is_pcapng_ = false;
  bool is_big_endian_ = false;
  bool has_nanoseconds_ = false;  // a pcap by its header
  bool has_long_fractions_ = false;
  std::uint32_t first_s_ = 0;  // of a pcap
  std::uint32_t last_s_ = 0;
  std::uint64_t packets_ = 0;
  std::vector<Interface> interfaces_;
  std::vector<std::byte> content_;
  std::uint64_t last_us_ = 0;
  std::string trouble_;
};

}  // namespace iog::tools
