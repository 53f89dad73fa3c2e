// Which unit sends these Velodyne packets: they do not always say it, and one unit's packets read
// as another's give a plausible wrong picture.
//
// Byte 1205 names the unit, but 0x21 is that of an HDL-32E and of a VLP-16 with firmware before
// 3.0.29, and an HDL-64E has no such byte. What differs is how long a block lasts. Two packets show
// it, whatever was lost between them: the azimuth gained in a packet, per block, times the time
// between the packets, by the azimuth gained between them. A single packet shows it only where its
// gain is too little or too much for one of the two at 5 to 20 turns a second.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lidar/formats.hpp"
#include "lidar/velodyne_look.hpp"

namespace iog::lidar {

// Formats, each at most once.
class FormatSet {
 public:
  constexpr FormatSet() = default;
  explicit constexpr FormatSet(Format format) { add(format); }

  constexpr void add(Format format) { bits_ |= 1U << static_cast<unsigned>(format); }
  [[nodiscard]] constexpr bool has(Format format) const {
    return (bits_ >> static_cast<unsigned>(format) & 1U) != 0;
  }
  // The one that Format names first. Only if there is one.
  [[nodiscard]] constexpr Format first() const {
    return static_cast<Format>(std::countr_zero(bits_));
  }
  [[nodiscard]] constexpr bool is_empty() const { return bits_ == 0; }
  friend constexpr bool operator==(const FormatSet&, const FormatSet&) = default;

 private:
  static_assert(kFormatCount <= 32);
  std::uint32_t bits_ = 0;
};

// A format that a packet may have, by what is written in it, and how long a block of it lasts.
struct VelodyneCandidate {
  Format format{};
  std::uint32_t block_ns = 0;
  friend constexpr bool operator==(const VelodyneCandidate&, const VelodyneCandidate&) = default;
};

// Of no packet can there be more.
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
  // The formats that the sender's packets can have, as far as this packet and those before it tell:
  // one where it is certain, none if the packet is no Velodyne's. Total; it looks at flags,
  // azimuths and time alone, and other faults of a packet are its decoder's.
  [[nodiscard]] FormatSet add(std::span<const std::byte> packet);
  // The same of one that its decoder has found sound.
  [[nodiscard]] FormatSet add(const VelodyneLook& look);

 private:
  void compare(const VelodyneLook& look);
  [[nodiscard]] FormatSet by_gain(const VelodyneLook& look) const;
  [[nodiscard]] FormatSet by_block_time(std::uint64_t block_ns) const;
  [[nodiscard]] FormatSet all() const;

  VelodyneCandidates candidates_;
  FormatSet possible_;
  VelodyneLook last_;
  // Of the pairs of packets since the last judgement.
  std::uint64_t gain_times_us_ = 0;
  std::uint64_t gain_times_blocks_ = 0;
  std::uint32_t gain_between_ = 0;
};

}  // namespace iog::lidar
