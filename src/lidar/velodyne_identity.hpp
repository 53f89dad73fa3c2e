// Identifies the unit that sends Velodyne packets. Packets do not always identify their unit. If
// packets of one unit are decoded as packets of a different unit, the points look plausible but are
// wrong.
//
// Byte 1205 identifies most units. However, an HDL-64E does not send this byte, and both an HDL-32E
// and a VLP-16 with firmware before 3.0.29 send 0x21. The duration of a block distinguishes these
// units. It can be computed from two packets that are at most 40 ms apart, even if packets between
// them were lost. The duration is the time between the two packets, multiplied by the azimuth
// increment per block and divided by the azimuth increment from one packet to the other. A single
// packet identifies one of these units only if the other units cannot produce the packet's azimuth
// increment at 5 to 20 turns per second.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lidar/formats.hpp"
#include "lidar/velodyne_look.hpp"

namespace iog::lidar {

// A set of formats.
class FormatSet {
 public:
  constexpr FormatSet() = default;
  explicit constexpr FormatSet(Format format) { add(format); }

  constexpr void add(Format format) { bits_ |= 1U << static_cast<unsigned>(format); }
  [[nodiscard]] constexpr bool has(Format format) const {
    return (bits_ >> static_cast<unsigned>(format) & 1U) != 0;
  }
  // Returns the first format of the set, in enum order. The set must not be empty.
  [[nodiscard]] constexpr Format first() const {
    return static_cast<Format>(std::countr_zero(bits_));
  }
  [[nodiscard]] constexpr bool is_empty() const { return bits_ == 0; }
  friend constexpr bool operator==(const FormatSet&, const FormatSet&) = default;

 private:
  static_assert(kFormatCount <= 32);
  std::uint32_t bits_ = 0;
};

// A format that is consistent with the bytes of a packet, and the block duration of this format.
struct VelodyneCandidate {
  Format format{};
  std::uint32_t block_ns = 0;
  friend constexpr bool operator==(const VelodyneCandidate&, const VelodyneCandidate&) = default;
};

// The formats that are consistent with a packet. There are at most four.
struct VelodyneCandidates {
  std::size_t count = 0;
  std::array<VelodyneCandidate, 4> list{};

  [[nodiscard]] constexpr std::span<const VelodyneCandidate> all() const {
    return std::span(list).first(count);
  }
  friend constexpr bool operator==(const VelodyneCandidates&, const VelodyneCandidates&) = default;
};

class VelodyneIdentity {
 public:
  // Returns the formats that are consistent with this packet and the previous packets of the
  // sender. The set contains one format if the result is certain, and is empty if the packet is not
  // from a Velodyne. The function accepts any bytes and checks only flags, azimuths and time. The
  // decoder detects other faults.
  [[nodiscard]] FormatSet add(std::span<const std::byte> packet);
  // Same as above, for a packet that its decoder has accepted.
  [[nodiscard]] FormatSet add(const VelodyneLook& look);

 private:
  void compare(const VelodyneLook& look);
  [[nodiscard]] FormatSet by_gain(const VelodyneLook& look) const;
  [[nodiscard]] FormatSet by_block_time(std::uint64_t block_ns) const;
  [[nodiscard]] FormatSet all() const;

  VelodyneCandidates candidates_;
  FormatSet possible_;
  VelodyneLook last_;
  // The sums from which the duration of a block is computed. They cover all pairs of consecutive
  // packets since the last result.
  std::uint64_t gain_times_us_ = 0;
  std::uint64_t gain_times_blocks_ = 0;
  std::uint32_t gain_between_ = 0;
};

}  // namespace iog::lidar
