// What is in a capture, port by port.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "tools/formats/capture/clock_pace.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/identity/unit_watch.hpp"

namespace iog::tools {

// What one sender sends to a port.
struct SenderCensus {
  UnitWatch unit;
  ClockPace pace;
  // Of sound packets. Scans are changes of scan number, or, of packets without one, turns begun.
  std::uint64_t scans = 0;
  std::uint32_t last_scan_number = 0;
  std::uint64_t first_us = 0;
  std::uint64_t last_us = 0;  // of those of units that turn; of others that of the last new scan
  std::uint64_t swept_ticks = 0;
  std::uint64_t gained_ticks = 0;  // by a unit that turns, from the first packet to the last
  std::uint32_t at_ticks = 0;
  std::uint32_t ticks_per_turn = 0;  // 0: it does not turn

  void add(const SeenUnit& seen, std::uint64_t time_us);
  // The share of directions that no packet of a unit that turns has, in percent; 0: hardly any.
  [[nodiscard]] int missing_percent() const;
  // Scans or turns a second, by what lies between the first and the last; 0: too little came.
  [[nodiscard]] double hertz() const;
};

struct PortCensus {
  std::uint64_t datagrams = 0;
  std::uint64_t bytes = 0;
  std::map<std::string, std::uint64_t> kinds{};  // datagrams of a known kind, by its name
  std::uint64_t in_doubt = 0;  // Velodyne packets of which it is not known which unit's they are
  std::string doubted;         // those that they may be of
  std::uint64_t points = 0;
  std::map<std::uint32_t, SenderCensus> senders;  // the first 64
  bool has_others = false;                        // further senders

  [[nodiscard]] std::uint64_t scans() const;
};

class CaptureCensus {
 public:
  void add(const CapturedDatagram& datagram);

  // A table, one line per destination port, and a line for each sender whose clock the capture's
  // times do not follow.
  [[nodiscard]] std::string table() const;

 private:
  static void add_unit(const CapturedDatagram& datagram, PortCensus& port);

  std::map<std::uint16_t, PortCensus> ports_;
};

}  // namespace iog::tools
