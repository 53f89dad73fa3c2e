// Which packets of one sensor belong to the current frame, and when its scan is complete.
//
// A scan is complete when the sectors of its packets, in any order, cover every tick of the width
// given in the car file.
//
// A LUX numbers its scans, and a frame holds at most one of them. A new number starts the next
// scan. Packets are late if the frame of their scan is closed. The scan of a spinning head has
// neither beginning nor end, and a frame may be shorter than a turn. So the next turn begins when a
// packet sweeps only what the frame has already swept. If turns are numbered, a packet of an older
// turn opens no frame.
//
// The next scan ends the frame. A unit whose stamps claim impossibly fast scans would therefore end
// frames without bound, so scans that begin too soon are dropped.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "intake/swept_sectors.hpp"
#include "lidar/scan_point.hpp"

namespace iog::intake {

class ScanTracker {
 public:
  enum class Outcome : std::uint8_t {
    kPartOfFrame,  // fuse it now
    kNextScan,     // the sensor's next scan has begun: close the frame, then ask again
    kDuplicate,    // the same packet was seen before
    kLate,         // its scan belongs to a closed frame
    kTooSoon,      // its scan begins sooner after the last one than any unit can scan
  };

  // turns: the scans are turns of a spinning head. scan_width_ticks: width of a whole scan.
  // packets: the maximum number of packets per scan. That many are remembered, but at least
  // kRemembered.
  ScanTracker(bool turns, std::uint32_t ticks_per_turn, std::uint16_t scan_width_ticks,
              std::uint32_t packets = 0)
      : swept_(ticks_per_turn),
        turns_(turns),
        scan_width_ticks_(scan_width_ticks),
        remembered_(std::clamp<std::size_t>(packets, kRemembered, kMaxRemembered)) {}
  ScanTracker() = default;

  [[nodiscard]] Outcome classify(const lidar::PacketInfo& packet) const;

  // Adds the packet to the frame. Call only after classify() returned kPartOfFrame.
  void accept(const lidar::PacketInfo& packet);

  // Closes the frame and forgets what was swept in it.
  void start_frame();

  [[nodiscard]] bool is_complete() const {
    return packets_ > 0 && swept_.count() >= scan_width_ticks_;
  }
  // Ticks of the turn swept in this frame.
  [[nodiscard]] std::uint32_t swept_ticks() const { return swept_.count(); }
  // Ticks of a sector not swept in this frame.
  [[nodiscard]] std::uint32_t missing_ticks(const lidar::Sector& sector) const {
    return swept_.missing_of(sector);
  }
  [[nodiscard]] std::uint16_t packets() const { return packets_; }  // in this frame
  [[nodiscard]] std::uint32_t points() const { return points_; }    // in those packets
  [[nodiscard]] std::uint32_t scan_number() const { return scan_number_; }
  // How many packets back a duplicate is recognised.
  [[nodiscard]] std::size_t remembered_packets() const { return remembered_; }
  [[nodiscard]] bool was_ever_seen() const { return fingerprint_count_ > 0; }
  [[nodiscard]] std::uint16_t age_frames() const { return age_frames_; }

 private:
  static constexpr std::size_t kRemembered = 192;
  // More than the packets of one dual-return turn of an HDL-64E S3 at 10 Hz, 579.
  static constexpr std::size_t kMaxRemembered = 640;
  // Half the shortest period of any unit: a LUX scans 50 times per second, others turn 20 times.
  static constexpr std::uint64_t kShortestScanUs = 10'000;
  static constexpr std::uint64_t kShortestTurnUs = 25'000;
  // A packet is late up to this many scans behind the last one. Further behind, the sensor has
  // restarted.
  static constexpr std::uint16_t kLateScans = 8;

  [[nodiscard]] bool is_known(std::uint64_t fingerprint) const;
  // Whether its scan is at most kLateScans before the newest one.
  [[nodiscard]] bool is_older(const lidar::PacketInfo& packet) const;
  [[nodiscard]] Outcome classify_scan(const lidar::PacketInfo& packet) const;
  [[nodiscard]] Outcome classify_turn(const lidar::PacketInfo& packet) const;
  // Whether the next scan begins with this packet too soon after the last one. Never true for
  // stamps that stand still or go back.
  [[nodiscard]] bool is_too_soon(const lidar::PacketInfo& packet) const {
    const std::uint64_t since_us = packet.sweep.begin_us - begin_us_;
    return since_us != 0 && since_us < kShortestScanUs;
  }
  // Whether the packet sweeps again a part of the turn that the frame has, and both begin within
  // less than the shortest turn. Never true if the clock has stepped in between, as one that counts
  // from the hour does every hour.
  [[nodiscard]] bool is_too_fast(const lidar::PacketInfo& packet) const {
    const std::uint64_t within_us =
        std::max(last_us_, packet.sweep.begin_us) - std::min(begin_us_, packet.sweep.begin_us);
    return within_us != 0 && within_us < kShortestTurnUs;
  }

  SweptSectors swept_;
  bool turns_ = false;
  std::uint32_t scan_width_ticks_ = 0;
  std::size_t remembered_ = kRemembered;
  std::uint16_t packets_ = 0;
  std::uint32_t points_ = 0;
  std::uint32_t scan_number_ = 0;  // newest one; always 0 if the format has none
  std::uint64_t begin_us_ = 0;     // of the newest scan, or of the part of a turn in this frame
  std::uint64_t last_us_ = 0;      // the latest start of a packet in this frame
  std::uint16_t age_frames_ = 0;
  std::array<std::uint64_t, kMaxRemembered> fingerprints_{};  // ring buffer
  std::size_t fingerprint_count_ = 0;
  std::size_t fingerprint_next_ = 0;
};

}  // namespace iog::intake
