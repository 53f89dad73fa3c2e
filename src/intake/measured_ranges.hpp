// Detects stuck sensors. A stuck sensor no longer measures, but repeats earlier ranges with new
// timestamps and sequence numbers.
//
// Measured ranges contain noise. The coarsest supported unit is an Ouster with a resolution of 8 mm
// and a standard deviation of 5 mm. This unit measures the same range twice in 41 of 100 cases. If
// a hash covers at least 64 ranges, the probability that two packets agree in all of them is
// therefore at most 10^-24. With 16 rows, a hash may cover as few as 32 ranges, which raises this
// probability to 10^-12. All other units either have a resolution of 5 mm or better, or are noisier
// than the Ouster. With these units, two ranges agree in at most 27 of 100 cases, so the
// probability that 32 ranges agree is 10^-18.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "intake/packet.hpp"
#include "lidar/sampling.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// Hashes the ranges of a packet. For a spinning unit, the hash covers up to 128 points, distributed
// evenly over the layers and firings of the packet. For other units, the hash covers all points.
class RangeDigest {
 public:
  // The value that represents a missing hash. A packet has no hash if too few of its sampled points
  // have returns, because their ranges might then repeat by chance.
  static constexpr std::uint64_t kNone = 0;

  explicit RangeDigest(const vehicle::Sensor& sensor);
  RangeDigest() = default;

  // Returns the hash of a valid packet of this sensor. Returns kNone if the packet has fewer than
  // 32 returns. For a spinning unit, also returns kNone if fewer than half of the sampled points
  // have a return.
  [[nodiscard]] std::uint64_t of(const Packet& packet) const;

 private:
  static constexpr std::size_t kMaxLayers = 32;

  std::array<std::uint8_t, kMaxLayers> layers_{};
  std::uint8_t layer_count_ = 0;  // 0 means all points
};

// The hashes of a sensor's latest packets. Hashes in the same bucket form a chain, like the strings
// in a deflate compressor (RFC 1951, section 4).
class RangeMemory {
 public:
  static constexpr std::size_t kMaxPackets = 1024;

  // Sets the number of previous packets to search. The number must be below kMaxPackets. It is 0
  // initially.
  void look_back(std::size_t packets) { packets_ = static_cast<std::uint32_t>(packets); }

  // Returns true if one of the previous packets had this hash. Returns false for kNone. The search
  // takes at most 16 steps.
  [[nodiscard]] bool knows(std::uint64_t digest) const;
  // Records a packet with this hash, whether or not the hash is new.
  void note(std::uint64_t digest);

 private:
  static constexpr std::size_t kHeads = 1024;
  [[nodiscard]] static std::size_t head_of(std::uint64_t digest) {
    return static_cast<std::uint32_t>(digest >> 54);
  }

  // Packets are numbered modulo 2^32. Entry i belongs to the packet whose number modulo kMaxPackets
  // is i.
  std::array<std::uint64_t, kMaxPackets> digests_{};
  std::array<std::uint32_t, kMaxPackets> before_{};  // number of the previous packet in its chain
  std::array<std::uint32_t, kHeads> newest_{};       // number of the newest packet of each chain
  std::uint32_t packets_ = 0;
  std::uint32_t number_ = kMaxPackets;  // number of the latest packet; at the start, 0 is too old
};

// Determines whether a sensor is still measuring. The order of a frame's packets matters only if
// two packets have equal ranges. In this case, the later packet is reported as frozen.
class FrozenWatch {
 public:
  // Sets the number of previous packets to search for a repetition. The number must be below
  // RangeMemory::kMaxPackets.
  void look_back(std::size_t packets) { memory_.look_back(packets); }

  // Returns true if a packet with this hash is frozen. A packet is frozen if it repeats earlier
  // ranges. A packet without a hash counts as frozen if its unit is frozen. A unit is frozen after
  // a frame in which it sent frozen packets but no new ones.
  [[nodiscard]] bool is_frozen(std::uint64_t digest) const {
    return digest == RangeDigest::kNone ? unit_is_frozen_ : memory_.knows(digest);
  }

  // `note_taken()` records a packet that was accepted. `note_frozen()` records a packet that was
  // dropped because it is frozen.
  void note_taken(std::uint64_t digest);
  void note_frozen(std::uint64_t digest);

  // Ends the frame and starts the next one.
  void start_frame();

 private:
  RangeMemory memory_;
  bool has_new_ = false;  // a new packet with a hash was received in this frame
  bool has_frozen_ = false;
  bool unit_is_frozen_ = false;
};

}  // namespace iog::intake
