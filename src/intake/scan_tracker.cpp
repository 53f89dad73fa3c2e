#include "intake/scan_tracker.hpp"

#include <algorithm>
#include <span>

namespace iog::intake {

bool ScanTracker::is_known(std::uint64_t fingerprint) const {
  const auto known = std::span(fingerprints_).first(fingerprint_count_);
  return std::ranges::find(known, fingerprint) != known.end();
}

ScanTracker::Outcome ScanTracker::classify(const lidar::PacketInfo& packet) const {
  if (is_known(packet.fingerprint)) {
    return Outcome::kDuplicate;
  }
  if (!was_ever_seen()) {
    return Outcome::kPartOfFrame;
  }
  // Scan numbers are 16 bits on the wire and wrap.
  const auto behind = static_cast<std::uint16_t>(scan_number_ - packet.scan_number);
  const bool is_numbered = has_numbers_ || packet.scan_number != 0;
  if (is_numbered && behind != 0) {
    if (behind <= kLateScans) {
      return Outcome::kLate;
    }
    return packets_ > 0 ? Outcome::kNextScan : Outcome::kPartOfFrame;
  }
  if (is_numbered) {
    return packets_ > 0 ? Outcome::kPartOfFrame : Outcome::kLate;
  }
  // Without numbers the next turn shows by sweeping only what has been swept.
  const bool sweeps_again =
      packets_ > 0 && packet.sector.width_ticks > 0 && swept_.missing_of(packet.sector) == 0;
  return sweeps_again ? Outcome::kNextScan : Outcome::kPartOfFrame;
}

void ScanTracker::accept(const lidar::PacketInfo& packet) {
  swept_.add(packet.sector);
  scan_number_ = packet.scan_number;
  has_numbers_ = has_numbers_ || packet.scan_number != 0;
  points_ += packet.point_count;
  packets_ = packets_ < 0xFFFF ? static_cast<std::uint16_t>(packets_ + 1) : packets_;
  fingerprints_[fingerprint_next_] = packet.fingerprint;
  fingerprint_next_ = fingerprint_next_ + 1 < remembered_ ? fingerprint_next_ + 1 : 0;
  fingerprint_count_ = std::min(fingerprint_count_ + 1, remembered_);
  age_frames_ = 0;
}

void ScanTracker::start_frame() {
  swept_.clear();
  packets_ = 0;
  points_ = 0;
  age_frames_ = age_frames_ < 0xFFFF ? static_cast<std::uint16_t>(age_frames_ + 1) : age_frames_;
}

}  // namespace iog::intake
