// What is in a capture, port by port.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "lidar/velodyne_identity.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/info/unit_guess.hpp"

namespace iog::tools {

struct PortCensus {
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  std::map<std::string, std::uint64_t> kinds{};  // datagrams of a known kind, by its name
  std::uint64_t in_doubt = 0;  // Velodyne packets of which it is not known which unit's they are
  lidar::FormatSet doubted;    // those that they may be of
  std::uint64_t points = 0;
  // Changes of scan number, or, of packets without one, turns, rounded down.
  std::uint64_t scans = 0;
  std::uint64_t swept_ticks = 0;  // of packets without scan number
  std::uint32_t last_scan_number = 0;
  std::uint64_t first_us = 0;
  std::uint64_t last_us = 0;
  std::set<std::uint32_t> sources;
  std::map<std::uint32_t, lidar::VelodyneIdentity> identities;  // by source
};

class CaptureCensus {
 public:
  void add(const CapturedDatagram& datagram);

  // A table, one line per destination port.
  [[nodiscard]] std::string table() const;

 private:
  static void add_numbered(const std::string& kind, const lidar::PacketInfo& info,
                           PortCensus& port);
  static void add_swept(const lidar::PacketInfo& info, std::uint32_t ticks_per_turn,
                        PortCensus& port);
  static void add_guessed(const GuessedPacket& guessed, PortCensus& port);
  static void add_velodyne(const CapturedDatagram& datagram, PortCensus& port);

  std::map<std::uint16_t, PortCensus> ports_;
};

// "10.0.2.15"
[[nodiscard]] std::string dotted(std::uint32_t ipv4);

}  // namespace iog::tools
