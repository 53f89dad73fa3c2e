// Which packets of one sensor belong to the current frame, and when its scan is complete.
//
// A scan is complete when the sectors of its packets, in whatever order they came, cover the width
// that the sensor's description gives. Sectors are kept as a bitmap of whole degrees.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>

#include "lidar/scan_point.hpp"

namespace iog::intake {

class ScanTracker {
 public:
  enum class Outcome : std::uint8_t {
    kPartOfFrame,  // fuse it now
    kNextScan,     // the sensor's next scan has begun: close the frame first, then ask again
    kDuplicate,    // this very packet has been seen
    kLate,         // of a scan whose frame is closed
  };

  // ticks_per_turn: a multiple of 360. scan_width_ticks: of a whole scan.
  ScanTracker(std::uint32_t ticks_per_turn, std::uint16_t scan_width_ticks)
      : ticks_per_bin_(ticks_per_turn / kBins), bins_needed_(scan_width_ticks / ticks_per_bin_) {}
  ScanTracker() = default;

  [[nodiscard]] Outcome classify(const lidar::PacketInfo& packet) const;

  // Counts the packet in. Only after classify() said kPartOfFrame.
  void accept(const lidar::PacketInfo& packet);

  // The frame is closed; what has been seen of the scan is over.
  void start_frame();

  [[nodiscard]] bool is_complete() const {
    return packets_ > 0 && bins_covered_.count() >= bins_needed_;
  }
  [[nodiscard]] std::uint16_t packets() const { return packets_; }  // in this frame
  [[nodiscard]] std::uint32_t points() const { return points_; }    // in those packets
  [[nodiscard]] std::uint32_t scan_number() const { return scan_number_; }
  [[nodiscard]] bool was_ever_seen() const { return fingerprint_count_ > 0; }
  [[nodiscard]] std::uint16_t age_frames() const { return age_frames_; }

 private:
  static constexpr std::uint32_t kBins = 360;
  // Longer than the packets of one dual-return VLP-16 turn, 151.
  static constexpr std::size_t kRemembered = 192;
  // A packet this many scans behind the last one is late; further behind, the sensor has restarted.
  static constexpr std::uint16_t kLateScans = 8;

  using Bins = std::bitset<kBins>;

  [[nodiscard]] bool is_known(std::uint64_t fingerprint) const;
  [[nodiscard]] Bins bins_of(const lidar::Sector& sector) const;

  std::uint32_t ticks_per_bin_ = 1;
  std::uint32_t bins_needed_ = 0;
  Bins bins_covered_;
  std::uint16_t packets_ = 0;
  std::uint32_t points_ = 0;
  std::uint32_t scan_number_ = 0;
  std::uint16_t age_frames_ = 0;
  std::array<std::uint64_t, kRemembered> fingerprints_{};  // a ring, the oldest is overwritten
  std::size_t fingerprint_count_ = 0;
  std::size_t fingerprint_next_ = 0;
};

}  // namespace iog::intake
