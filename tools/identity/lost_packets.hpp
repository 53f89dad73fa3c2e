// Detects the packets of a unit that are missing in a recording.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "lidar/scan_point.hpp"

namespace iog::tools {

// In a unit that turns, a missing packet leaves a gap between the directions of its neighbours. A
// gap of a limited field of view contains directions that no packet has, so it does not count.
// A LUX numbers its scans, and the sectors of a scan's messages add up to the same width.
// After a second without a packet, nothing counts.
class LostPackets {
 public:
  // Takes the next packet of the unit. ticks_per_turn is 0 for a LUX.
  void add(const lidar::PacketInfo& info, std::uint32_t source_ipv4, std::uint32_t ticks_per_turn);
  // Notes a packet that is not sound: it is not missing.
  void skip() {
    is_whole_ = false;
    damaged_scans_ = 2;
  }

  // Returns "about 226 of 754 packets of roof (30 %) are missing: ...", or an empty text if less
  // than 1 % is missing. Complete when everything has been read.
  [[nodiscard]] std::string words(const std::string& name) const;

 private:
  // Of 0.25 degrees each.
  static constexpr std::size_t kDirections = 1440;

  void add_turning(const lidar::PacketInfo& info, std::uint64_t since_us, std::uint32_t turn);
  void add_scan(const lidar::PacketInfo& info);
  [[nodiscard]] double step_ticks() const {
    return static_cast<double>(turned_ticks_) / static_cast<double>(steps_);
  }
  [[nodiscard]] double packets_missing() const;
  [[nodiscard]] double scans_missing(std::uint64_t came) const;

  std::uint32_t source_ipv4_ = 0;
  bool is_whole_ = false;  // the packet before was sound and of the same source
  bool is_next_ = false;   // and less than a second ago
  std::uint64_t time_us_ = 0;
  std::array<std::uint64_t, 8> fingerprints_{};  // of the last packets
  std::uint64_t packets_ = 0;
  std::uint64_t overtaken_ = 0;

  // Of a unit that turns.
  std::uint32_t ticks_per_turn_ = 0;
  std::uint32_t at_ticks_ = 0;
  std::array<bool, kDirections> seen_{};
  std::map<std::pair<std::size_t, std::size_t>, double> gaps_;  // packets, by first and last
  std::uint64_t steps_ = 0;      // from packet to packet without a gap
  std::uint64_t turned_us_ = 0;  // in these steps, on the unit's clock
  std::uint64_t turned_ticks_ = 0;
  std::uint64_t turns_missing_ = 0;

  // Of a LUX.
  std::uint16_t number_ = 0;
  std::uint32_t width_ticks_ = 0;                 // of this scan so far
  std::map<std::uint32_t, std::uint64_t> scans_;  // by width
  std::uint64_t successors_ = 0;                  // scans with the next number
  std::uint64_t numbers_missing_ = 0;
  int damaged_scans_ = 0;  // of this scan and the next: one of their messages was not sound
};

}  // namespace iog::tools
