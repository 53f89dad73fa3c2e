// Determines which packets of a sensor belong to the current frame, and when the sensor's scan is
// complete.
//
// A scan is complete when the sectors of its packets cover every tick of the scan width in the car
// file. The order of the packets does not matter.
//
// A LUX numbers its scans, and a frame contains at most one scan of each LUX. A new number starts
// the next scan. A packet is late if the frame of its scan has already been closed. The scan of a
// spinning lidar has no beginning or end, and a frame may be shorter than a turn. The next turn
// therefore begins when a packet sweeps only azimuths that have already been swept in the frame. If
// turns are numbered, a packet of an older turn does not start a new frame.
//
// The frame ends when the next scan begins. Scans that begin too soon are dropped. Without this
// rule, a unit could send impossibly fast scans and end frames at an unbounded rate.
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
    kNextScan,     // the sensor's next scan has begun: close the frame, then call classify() again
    kDuplicate,    // the same packet was seen before
    kLate,         // the frame of its scan has been closed
    kTooSoon,      // its scan begins too soon after the last scan for any unit
  };

  // `turns` is true if the scans are turns of a spinning lidar. `scan_width_ticks` is the width of
  // a whole scan. `packets` is the maximum number of packets per scan. The number of packets that
  // the tracker remembers is `packets`, clamped to [kRemembered, kMaxRemembered].
  ScanTracker(bool turns, std::uint32_t ticks_per_turn, std::uint16_t scan_width_ticks,
              std::uint32_t packets = 0)
      : swept_(ticks_per_turn),
        turns_(turns),
        scan_width_ticks_(scan_width_ticks),
        remembered_(std::clamp<std::size_t>(packets, kRemembered, kMaxRemembered)) {}
  ScanTracker() = default;

  [[nodiscard]] Outcome classify(const lidar::PacketInfo& packet) const;

  // Adds the packet to the current frame. Call this function only after classify() has returned
  // kPartOfFrame.
  void accept(const lidar::PacketInfo& packet);

  // Ends the frame and clears the set of swept sectors.
  void start_frame();

  [[nodiscard]] bool is_complete() const {
    return packets_ > 0 && swept_.count() >= scan_width_ticks_;
  }
  // Returns the number of ticks that the sensor has swept in this frame.
  [[nodiscard]] std::uint32_t swept_ticks() const { return swept_.count(); }
  // Returns true if the sensor has left more than `ticks` ticks of the sector unswept in this
  // frame.
  [[nodiscard]] bool misses_more_than(std::uint32_t ticks, const lidar::Sector& sector) const {
    return swept_.misses_more_than(ticks, sector);
  }
  [[nodiscard]] std::uint16_t packets() const { return packets_; }  // packets in this frame
  [[nodiscard]] std::uint32_t points() const { return points_; }    // points in these packets
  [[nodiscard]] std::uint32_t scan_number() const { return scan_number_; }
  // Returns the number of previous packets that are searched for duplicates.
  [[nodiscard]] std::size_t remembered_packets() const { return remembered_; }
  [[nodiscard]] bool was_ever_seen() const { return fingerprint_count_ > 0; }
  [[nodiscard]] std::uint16_t age_frames() const { return age_frames_; }

 private:
  static constexpr std::size_t kRemembered = 192;
  // This maximum exceeds 579, which is the number of packets in one dual-return turn of an HDL-64E
  // S3 at 10 Hz.
  static constexpr std::size_t kMaxRemembered = 640;
  // Half the shortest scan period of any unit. A LUX scans up to 50 times per second, and other
  // units turn up to 20 times per second.
  static constexpr std::uint64_t kShortestScanUs = 10'000;
  static constexpr std::uint64_t kShortestTurnUs = 25'000;
  // A packet belongs to an earlier scan if its scan number is at most kLateScans behind the newest
  // scan number. If it is further behind, the sensor has restarted.
  static constexpr std::uint16_t kLateScans = 8;

  [[nodiscard]] bool is_known(std::uint64_t fingerprint) const;
  // Returns true if the packet belongs to an earlier scan (see kLateScans).
  [[nodiscard]] bool is_older(const lidar::PacketInfo& packet) const;
  [[nodiscard]] Outcome classify_scan(const lidar::PacketInfo& packet) const;
  [[nodiscard]] Outcome classify_turn(const lidar::PacketInfo& packet) const;
  // Returns true if the packet begins the next scan too soon after the last scan. Returns false if
  // the packet does not begin later than the last scan.
  [[nodiscard]] bool is_too_soon(const lidar::PacketInfo& packet) const {
    const std::uint64_t since_us = packet.sweep.begin_us - begin_us_;
    return since_us != 0 && since_us < kShortestScanUs;
  }
  // Call this function for a packet that sweeps the same azimuths again. Returns true if this
  // packet and the packets of the frame all begin within a period shorter than kShortestTurnUs.
  // Returns false if the clock jumped by at least kShortestTurnUs after the first sweep. For
  // example, a clock that counts from the start of the hour jumps back every hour.
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
  std::uint32_t scan_number_ = 0;  // number of the newest scan; always 0 if the format has none
  std::uint64_t begin_us_ = 0;     // start of the newest scan or of the part of a turn in the frame
  std::uint64_t last_us_ = 0;      // latest start of a packet in this frame
  std::uint16_t age_frames_ = 0;
  // A ring buffer of the halves of fingerprints.
  std::array<std::uint32_t, kMaxRemembered> fingerprints_low_{};
  std::array<std::uint32_t, kMaxRemembered> fingerprints_high_{};
  std::size_t fingerprint_count_ = 0;
  std::size_t fingerprint_next_ = 0;
};

}  // namespace iog::intake
