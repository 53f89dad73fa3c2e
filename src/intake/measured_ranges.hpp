// What a scanner has measured, so that one that measures no more is found: it sends what it has
// sent before, under new stamps and numbers.
//
// A measured range has noise. The coarsest unit here, an Ouster in steps of 8 mm that vary by 5 mm,
// measures the same range twice in 41 of 100 cases: of two packets all of 64 or more ranges agree
// once in 10^24, and of 16 rows, where 32 may be enough, once in 10^12. Others measure to 5 mm or
// finer, or vary more: they agree in at most 27 of 100 cases, and 32 of them once in 10^18.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "intake/packet.hpp"
#include "lidar/sampling.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// A number for the ranges of a packet: of all points of a unit that does not turn; of one that
// turns, of up to 128 points, spread evenly over its layers and the packet's firings.
class RangeDigest {
 public:
  // Of a packet with fewer returns among the points looked at: it may well come twice.
  static constexpr std::uint64_t kNone = 0;

  explicit RangeDigest(const vehicle::Sensor& sensor);
  RangeDigest() = default;

  // Of a sound packet of that sensor. kNone with fewer than 32 returns, or returns from fewer than
  // half of the points of a unit that turns.
  [[nodiscard]] std::uint64_t of(const Packet& packet) const;

 private:
  static constexpr std::size_t kMaxLayers = 32;

  std::array<std::uint8_t, kMaxLayers> layers_{};
  std::uint8_t layer_count_ = 0;  // 0: of all points
};

// The digests of a sensor's last packets, found by chains of those with the same hash, as a
// compressor finds the strings that it has seen (RFC 1951, section 4).
class RangeMemory {
 public:
  static constexpr std::size_t kMaxPackets = 1024;

  // How many packets back it looks, below kMaxPackets; at first none.
  void look_back(std::size_t packets) { packets_ = static_cast<std::uint32_t>(packets); }

  // Whether one of the last packets had this digest. Never of kNone. At most 16 steps.
  [[nodiscard]] bool knows(std::uint64_t digest) const;
  // A packet with this digest came, or came again.
  void note(std::uint64_t digest);

 private:
  static constexpr std::size_t kHeads = 1024;
  [[nodiscard]] static std::size_t head_of(std::uint64_t digest) {
    return static_cast<std::uint32_t>(digest >> 54);
  }

  // Packets are counted, modulo 2^32; each has the place of its number modulo kMaxPackets.
  std::array<std::uint64_t, kMaxPackets> digests_{};
  std::array<std::uint32_t, kMaxPackets> before_{};  // the last one before it in its chain
  std::array<std::uint32_t, kHeads> newest_{};       // of each chain
  std::uint32_t packets_ = 0;
  std::uint32_t number_ = kMaxPackets;  // of the last packet; none is older than so many packets
};

// Whether a sensor still measures. The order of a frame's packets matters only if two have equal
// ranges: then the later one is frozen.
class FrozenWatch {
 public:
  // How many packets back a repeated one is known, below RangeMemory::kMaxPackets.
  void look_back(std::size_t packets) { memory_.look_back(packets); }

  // Whether a packet with this digest is measured anew. What is not judged goes with the unit: it
  // is frozen after a frame in which packets came again, and none was new.
  [[nodiscard]] bool is_frozen(std::uint64_t digest) const {
    return digest == RangeDigest::kNone ? unit_is_frozen_ : memory_.knows(digest);
  }

  // The packet was taken, or left because it is frozen.
  void note_taken(std::uint64_t digest);
  void note_frozen(std::uint64_t digest);

  // The frame is closed.
  void start_frame();

 private:
  RangeMemory memory_;
  bool has_new_ = false;  // packets in this frame, of those that are judged
  bool has_frozen_ = false;
  bool unit_is_frozen_ = false;
};

}  // namespace iog::intake
