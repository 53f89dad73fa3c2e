// Writes UDP datagrams as a standard capture file: pcap, Ethernet, microseconds, right checksums.
// What does not fit into one frame becomes fragments, all of the datagram's time.
//
// The bytes depend on nothing but the datagrams.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/formats/capture/datagram.hpp"
#include "tools/program/file.hpp"

struct pcap;
struct pcap_dumper;

namespace iog::tools {

class PcapWriter {
 public:
  // UsageError if the file cannot be written. Without keep_beginning() and finish(), an older file
  // stays (OutputPlace).
  explicit PcapWriter(const std::string& path);
  // Payloads of at most 65,507 bytes. UsageError if the disk is full.
  void write(const CapturedDatagram& datagram);

  // Replaces an older file now, even if finish() is never called.
  void keep_beginning() { place_.finish(); }

  // UsageError if not all bytes have reached the file. Nothing may be written after it.
  void finish();

  // The longest payload of UDP over IPv4.
  static constexpr std::size_t kMaxPayloadBytes = 65'535 - 20 - 8;

 private:
  void write_frame(std::uint64_t time_us, std::span<const std::byte> frame);

  struct Closer {
    void operator()(pcap* file) const;
    void operator()(pcap_dumper* file) const;
  };

  std::string path_;
  OutputPlace place_;
  std::unique_ptr<pcap, Closer> link_;
  std::unique_ptr<pcap_dumper, Closer> file_;
  std::uint16_t identification_ = 0;
};

}  // namespace iog::tools
