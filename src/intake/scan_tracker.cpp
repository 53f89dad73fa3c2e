#include "intake/scan_tracker.hpp"

namespace iog::intake {

// Nearly all packets are new, so an early exit saves nothing. Without it, SIMD compares several
// halves at once.
bool ScanTracker::is_known(std::uint64_t fingerprint) const {
  const auto low = static_cast<std::uint32_t>(fingerprint);
  const auto high = static_cast<std::uint32_t>(fingerprint >> 32);
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < fingerprint_count_; ++i) {
    found |= static_cast<std::uint32_t>(fingerprints_low_[i] == low) &
             static_cast<std::uint32_t>(fingerprints_high_[i] == high);
  }
  return found != 0;
}

// Scan numbers have 16 bits on the wire and wrap.
bool ScanTracker::is_older(const lidar::PacketInfo& packet) const {
  const auto behind = static_cast<std::uint16_t>(scan_number_ - packet.scan_number);
  return behind != 0 && behind <= kLateScans;
}

ScanTracker::Outcome ScanTracker::classify(const lidar::PacketInfo& packet) const {
  if (is_known(packet.fingerprint)) {
    return Outcome::kDuplicate;
  }
  if (!was_ever_seen()) {
    return Outcome::kPartOfFrame;
  }
  return turns_ ? classify_turn(packet) : classify_scan(packet);
}

ScanTracker::Outcome ScanTracker::classify_scan(const lidar::PacketInfo& packet) const {
  if (is_older(packet)) {
    return Outcome::kLate;
  }
  if (packet.scan_number == scan_number_) {
    return packets_ > 0 ? Outcome::kPartOfFrame : Outcome::kLate;
  }
  if (is_too_soon(packet)) {
    return Outcome::kTooSoon;
  }
  return packets_ > 0 ? Outcome::kNextScan : Outcome::kPartOfFrame;
}

// A packet of an older turn may fill a gap of the frame, but neither begins nor ends one.
ScanTracker::Outcome ScanTracker::classify_turn(const lidar::PacketInfo& packet) const {
  const bool sweeps_again =
      packets_ > 0 && packet.sector.width_ticks > 0 && !swept_.misses_more_than(0, packet.sector);
  if (is_older(packet)) {
    return packets_ == 0 || sweeps_again ? Outcome::kLate : Outcome::kPartOfFrame;
  }
  if (sweeps_again && is_too_fast(packet)) {
    return Outcome::kTooSoon;
  }
  return sweeps_again ? Outcome::kNextScan : Outcome::kPartOfFrame;
}

void ScanTracker::accept(const lidar::PacketInfo& packet) {
  begin_us_ = packets_ == 0 ? packet.sweep.begin_us : std::min(begin_us_, packet.sweep.begin_us);
  last_us_ = packets_ == 0 ? packet.sweep.begin_us : std::max(last_us_, packet.sweep.begin_us);
  scan_number_ = was_ever_seen() && is_older(packet) ? scan_number_ : packet.scan_number;
  swept_.add(packet.sector);
  points_ += packet.point_count;
  packets_ = packets_ < 0xFFFF ? static_cast<std::uint16_t>(packets_ + 1) : packets_;
  fingerprints_low_[fingerprint_next_] = static_cast<std::uint32_t>(packet.fingerprint);
  fingerprints_high_[fingerprint_next_] = static_cast<std::uint32_t>(packet.fingerprint >> 32);
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
