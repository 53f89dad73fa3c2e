// What is in a capture, port by port.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "tools/formats/capture/datagram.hpp"

namespace iog::tools {

struct PortCensus {
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  std::uint64_t lux = 0;    // datagrams that are an ibeo 0x2202 message
  std::uint64_t vlp16 = 0;  // datagrams that are a VLP-16 data packet
  std::uint64_t points = 0;
  std::uint64_t scans = 0;        // LUX: changes of scan number; VLP-16: turns, rounded down
  std::uint64_t swept_ticks = 0;  // VLP-16
  std::uint32_t last_scan_number = 0;
  std::uint64_t first_us = 0;
  std::uint64_t last_us = 0;
  std::set<std::uint32_t> sources;
};

class CaptureCensus {
 public:
  void add(const CapturedDatagram& datagram);

  [[nodiscard]] const std::map<std::uint16_t, PortCensus>& ports() const { return ports_; }

  // A table, one line per destination port.
  [[nodiscard]] std::string table() const;

 private:
  std::map<std::uint16_t, PortCensus> ports_;
};

// "10.0.2.15"
[[nodiscard]] std::string dotted(std::uint32_t ipv4);

}  // namespace iog::tools
