// Which packets of one sensor belong to the current frame, and when its scan is complete.
//
// A scan is complete when the sectors of its packets, in whatever order they came, cover the width
// that the sensor's description gives, tick by tick.
//
// A LUX numbers its scans, and a frame holds at most one of them: another number is the next scan,
// and what comes of one whose frame is closed is late. A head that turns has neither beginning nor
// end, and a frame may be shorter than a turn: the next turn shows by sweeping only what the frame
// has swept. Where turns are numbered, what is of an older one opens no frame.
//
// A next scan ends the frame, so a unit that scans faster than it can, by its own stamps, would end
// frames without bound. What begins too soon is left.
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
    kNextScan,     // the sensor's next scan has begun: close the frame first, then ask again
    kDuplicate,    // this very packet has been seen
    kLate,         // of a scan whose frame is closed
    kTooSoon,      // of a next scan that begins sooner after the last one than any unit scans
  };

  // turns: its scans are those of a head that turns. scan_width_ticks: of a whole scan. packets:
  // the most that a scan comes in; so many are remembered, or kRemembered if that is more.
  ScanTracker(bool turns, std::uint32_t ticks_per_turn, std::uint16_t scan_width_ticks,
              std::uint32_t packets = 0)
      : swept_(ticks_per_turn),
        turns_(turns),
        scan_width_ticks_(scan_width_ticks),
        remembered_(std::clamp<std::size_t>(packets, kRemembered, kMaxRemembered)) {}
  ScanTracker() = default;

  [[nodiscard]] Outcome classify(const lidar::PacketInfo& packet) const;

  // Counts the packet in. Only after classify() said kPartOfFrame.
  void accept(const lidar::PacketInfo& packet);

  // The frame is closed; what has been seen of the scan is over.
  void start_frame();

  [[nodiscard]] bool is_complete() const {
    return packets_ > 0 && swept_.count() >= scan_width_ticks_;
  }
  // How many ticks of its turn it has swept in this frame.
  [[nodiscard]] std::uint32_t swept_ticks() const { return swept_.count(); }
  // Ticks of a sector that it has not.
  [[nodiscard]] std::uint32_t missing_ticks(const lidar::Sector& sector) const {
    return swept_.missing_of(sector);
  }
  [[nodiscard]] std::uint16_t packets() const { return packets_; }  // in this frame
  [[nodiscard]] std::uint32_t points() const { return points_; }    // in those packets
  [[nodiscard]] std::uint32_t scan_number() const { return scan_number_; }
  // How many packets back a duplicate is known.
  [[nodiscard]] std::size_t remembered_packets() const { return remembered_; }
  [[nodiscard]] bool was_ever_seen() const { return fingerprint_count_ > 0; }
  [[nodiscard]] std::uint16_t age_frames() const { return age_frames_; }

 private:
  static constexpr std::size_t kRemembered = 192;
  // Longer than the packets of one dual-return turn of an HDL-64E S3 at 10 Hz, 579.
  static constexpr std::size_t kMaxRemembered = 640;
  // No unit here scans or turns twice as fast: a LUX scans 50 times a second, others turn 20 times.
  static constexpr std::uint64_t kShortestScanUs = 10'000;
  static constexpr std::uint64_t kShortestTurnUs = 25'000;
  // A packet this many scans behind the last one is late; further behind, the sensor has restarted.
  static constexpr std::uint16_t kLateScans = 8;

  [[nodiscard]] bool is_known(std::uint64_t fingerprint) const;
  // Of a scan at most kLateScans before the newest.
  [[nodiscard]] bool is_older(const lidar::PacketInfo& packet) const;
  [[nodiscard]] Outcome classify_scan(const lidar::PacketInfo& packet) const;
  [[nodiscard]] Outcome classify_turn(const lidar::PacketInfo& packet) const;
  // Whether a next scan begins with this packet too soon after the last one. Of stamps that stand
  // still or go back it is not asked.
  [[nodiscard]] bool is_too_soon(const lidar::PacketInfo& packet) const {
    const std::uint64_t since_us = packet.sweep.begin_us - begin_us_;
    return since_us != 0 && since_us < kShortestScanUs;
  }
  // Whether the packet sweeps again a part of a turn that the frame has, and both begin within less
  // than the shortest turn. They do not if the clock has stepped in between, as one that counts
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
  std::uint32_t scan_number_ = 0;  // the newest; always 0 where the format has none
  std::uint64_t begin_us_ = 0;     // of the newest scan; of a turn's part in this frame
  std::uint64_t last_us_ = 0;      // the latest start of a packet in this frame
  std::uint16_t age_frames_ = 0;
  std::array<std::uint64_t, kMaxRemembered> fingerprints_{};  // a ring, the oldest is overwritten
  std::size_t fingerprint_count_ = 0;
  std::size_t fingerprint_next_ = 0;
};

}  // namespace iog::intake
