// Detects a frozen sensor: one that no longer measures, but sends earlier ranges again under new
// stamps and numbers.
//
// Measured ranges have noise. The coarsest unit here is an Ouster with steps of 8 mm that vary by 5
// mm. It measures the same range twice in 41 of 100 cases. So two packets agree in all of 64 or
// more ranges once in 10^24. With 16 rows, where 32 ranges may be enough, they agree once in 10^12.
// Other units measure to 5 mm or finer, or vary more. Their ranges agree in at most 27 of 100
// cases, and 32 of them once in 10^18.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "intake/packet.hpp"
#include "lidar/sampling.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// A hash of the ranges of a packet. For a spinning unit it covers up to 128 points, spread evenly
// over its layers and the packet's firings. For other units it covers all points.
class RangeDigest {
 public:
  // No digest: the sampled points have so few returns that their ranges may repeat by chance.
  static constexpr std::uint64_t kNone = 0;

  explicit RangeDigest(const vehicle::Sensor& sensor);
  RangeDigest() = default;

  // The digest of a sound packet of that sensor. kNone if there are fewer than 32 returns, or if
  // less than half of the points of a spinning unit return.
  [[nodiscard]] std::uint64_t of(const Packet& packet) const;

 private:
  static constexpr std::size_t kMaxLayers = 32;

  std::array<std::uint8_t, kMaxLayers> layers_{};
  std::uint8_t layer_count_ = 0;  // 0: all points
};

// The digests of a sensor's latest packets. Digests with the same hash form a chain, like the
// strings in a compressor (RFC 1951, section 4).
class RangeMemory {
 public:
  static constexpr std::size_t kMaxPackets = 1024;

  // Sets how many packets back the search goes, below kMaxPackets. Initially none.
  void look_back(std::size_t packets) { packets_ = static_cast<std::uint32_t>(packets); }

  // Whether one of these packets had this digest. False for kNone. At most 16 steps.
  [[nodiscard]] bool knows(std::uint64_t digest) const;
  // Notes a packet with this digest, new or repeated.
  void note(std::uint64_t digest);

 private:
  static constexpr std::size_t kHeads = 1024;
  [[nodiscard]] static std::size_t head_of(std::uint64_t digest) {
    return static_cast<std::uint32_t>(digest >> 54);
  }

  // Packets are numbered modulo 2^32. Entry i belongs to the packet whose number is i modulo
  // kMaxPackets.
  std::array<std::uint64_t, kMaxPackets> digests_{};
  std::array<std::uint32_t, kMaxPackets> before_{};  // number of the packet before it in its chain
  std::array<std::uint32_t, kHeads> newest_{};       // number of the newest packet of each chain
  std::uint32_t packets_ = 0;
  std::uint32_t number_ = kMaxPackets;  // of the latest packet; at the start, 0 is too old
};

// Whether a sensor still measures. The order of the packets of a frame matters only if two have
// equal ranges: then the later one is frozen.
class FrozenWatch {
 public:
  // Sets how many packets back a repetition is recognised, below RangeMemory::kMaxPackets.
  void look_back(std::size_t packets) { memory_.look_back(packets); }

  // Whether a packet with this digest is frozen, that is, repeats earlier ranges. A packet without
  // a digest is frozen if its unit is. A unit is frozen after a frame in which packets were
  // repeated and none was new.
  [[nodiscard]] bool is_frozen(std::uint64_t digest) const {
    return digest == RangeDigest::kNone ? unit_is_frozen_ : memory_.knows(digest);
  }

  // Notes a packet that was taken, or dropped because it is frozen.
  void note_taken(std::uint64_t digest);
  void note_frozen(std::uint64_t digest);

  // Closes the frame.
  void start_frame();

 private:
  RangeMemory memory_;
  bool has_new_ = false;  // packets with a digest in this frame
  bool has_frozen_ = false;
  bool unit_is_frozen_ = false;
};

}  // namespace iog::intake
