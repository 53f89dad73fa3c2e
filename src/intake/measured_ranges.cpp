#include "intake/measured_ranges.hpp"

#include <algorithm>

#include "lidar/fingerprint.hpp"

namespace iog::intake {
namespace {

constexpr std::uint32_t kFewestReturns = 32;
constexpr int kLog2Firings = 2;

// FNV-1a (lidar/fingerprint.hpp), one range at a time.
class Ranges {
 public:
  void operator()(std::uint32_t range) {
    hash_ = (hash_ ^ range) * lidar::kFingerprintPrime;
    returns_ += range != 0 ? 1U : 0U;
    ++ranges_;
  }

  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  [[nodiscard]] std::uint32_t returns() const { return returns_; }
  [[nodiscard]] std::uint32_t ranges() const { return ranges_; }

 private:
  std::uint64_t hash_ = lidar::kFingerprintStart;
  std::uint32_t returns_ = 0;
  std::uint32_t ranges_ = 0;
};

}  // namespace

RangeDigest::RangeDigest(const vehicle::Sensor& sensor) {
  if (!lidar::turns(sensor.format)) {
    return;
  }
  const std::size_t layers = sensor.layer_count;
  const std::size_t sampled = std::min(layers, kMaxLayers);
  for (std::size_t i = 0; i < sampled; ++i) {
    layers_[i] = static_cast<std::uint8_t>(i * layers / sampled);
  }
  layer_count_ = static_cast<std::uint8_t>(sampled);
}

std::uint64_t RangeDigest::of(const Packet& packet) const {
  const auto layers = std::span(layers_).first(layer_count_);
  const auto ranges =
      packet.for_each_range({.layers = layers, .log2_firings = kLog2Firings}, Ranges{});
  const std::uint32_t fewest = layers.empty() ? 0 : ranges.ranges() / 2;
  return ranges.returns() < std::max(kFewestReturns, fewest) ? kNone : ranges.hash();
}

bool RangeMemory::knows(std::uint64_t digest) const {
  constexpr int kSteps = 16;
  if (digest == RangeDigest::kNone) {
    return false;
  }
  std::uint32_t number = newest_[head_of(digest)];
  for (int step = 0; step < kSteps && number_ - number < packets_; ++step) {
    if (digests_[number % kMaxPackets] == digest) {
      return true;
    }
    number = before_[number % kMaxPackets];
  }
  return false;
}

void RangeMemory::note(std::uint64_t digest) {
  ++number_;
  std::uint32_t& newest = newest_[head_of(digest)];
  digests_[number_ % kMaxPackets] = digest;
  before_[number_ % kMaxPackets] = newest;
  newest = number_;
}

void FrozenWatch::note_taken(std::uint64_t digest) {
  memory_.note(digest);
  has_new_ = has_new_ || digest != RangeDigest::kNone;
}

// Frozen packets are noted, too, because they repeat as long as the unit is frozen.
void FrozenWatch::note_frozen(std::uint64_t digest) {
  memory_.note(digest);
  has_frozen_ = has_frozen_ || digest != RangeDigest::kNone;
}

// A frame without any packet that has a digest changes nothing.
void FrozenWatch::start_frame() {
  if (has_new_ || has_frozen_) {
    unit_is_frozen_ = !has_new_;
  }
  has_new_ = false;
  has_frozen_ = false;
}

}  // namespace iog::intake
