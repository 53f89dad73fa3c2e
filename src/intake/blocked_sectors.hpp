// Blocked sectors: nearly nothing returns to a sensor although something should, because a cap, ice
// or mud covers its window, or it is broken. Open sky returns nothing either, so each sector
// (watched_sectors.hpp) is judged by beams that must return:
//
// - ground: a unit that turns, where its beams meet the car's plane within 20 m and at 1 in 16 or
//   steeper. A turn blocks the sector if less than a sixteenth of these beams returns, and if the
//   same is true of all its beams, or a quarter of these returned before (a running mean, 1/32 a
//   turn). Three turns in which an eighth of these, or else of all, returns open it.
// - sky: the other sectors of such a unit. Each is blocked while all ground sectors are.
// - level: a unit that does not turn or sees no ground, where a beam rises by less than 1 in 32. 32
//   scans without a return block the sector, and two with one open it. Three scans without any
//   return block the whole unit.
//
// Returns nearer than the sensor's minimum, and those that it flags as dirt or rain, do not count.
// Only whole turns and scans are judged, by sums over packets, so their order does not matter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "intake/packet.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

inline constexpr std::size_t kSectors = 64;

// The azimuths between which a sensor sees a sector; of width 0 if it does not reach it.
using SectorView = std::array<lidar::Sector, kSectors>;

// Azimuths, in 256 parts of a turn.
class AzimuthParts {
 public:
  static constexpr std::size_t kParts = 256;

  explicit AzimuthParts(std::uint32_t ticks_per_turn) : ticks_per_turn_(ticks_per_turn) {}

  [[nodiscard]] std::size_t part_of(std::uint32_t azimuth_ticks) const {
    return azimuth_ticks * kParts / ticks_per_turn_;
  }
  [[nodiscard]] bool contain(std::uint32_t azimuth_ticks) const {
    const std::size_t part = part_of(azimuth_ticks);
    return (bits_[part / 64] >> part % 64 & 1U) != 0;
  }
  void add(std::size_t part) { bits_[part / 64] |= std::uint64_t{1} << part % 64; }

 private:
  std::uint32_t ticks_per_turn_;
  std::array<std::uint64_t, kParts / 64> bits_{};
};

// Of one sensor.
class BlockedSectors {
 public:
  // Both outlive it.
  BlockedSectors(const vehicle::Sensor& sensor, const SectorView& view);
  BlockedSectors() = default;

  // The packet is part of the frame at hand.
  void add(const Packet& packet);

  // Whether the frame at hand has any return.
  [[nodiscard]] bool has_returns() const { return frame_returns_ > 0; }

  struct State {
    std::array<std::int16_t, kSectors> levels{};
    std::array<std::uint16_t, kSectors> gave{};  // mean share of low beams that return, of kAllGave
    std::uint8_t empty_turns = 0;
    // Bit i: the sensor has looked into sector i since start; it is blocked there.
    std::uint64_t seen = 0;
    std::uint64_t blocked = 0;
  };

  // The state after the frame at hand, in which the sensor swept that many ticks and all of these
  // sectors.
  [[nodiscard]] State after_frame(std::uint32_t swept_ticks, std::uint64_t swept) const;
  // The frame is closed.
  void end_frame(std::uint32_t swept_ticks, std::uint64_t swept);

  // The azimuths of a packet in which a missing return is no evidence: its sector was blocked in
  // the frames before, or less than a sixteenth of the judged beams return in this very packet,
  // there or beside it.
  [[nodiscard]] AzimuthParts silent_azimuths(const Packet& packet) const;

 private:
  enum class Kind : std::uint8_t { kUnseen, kGround, kLevel, kSky };
  static constexpr std::size_t kMaxSampled = 32;
  static constexpr std::int16_t kFull = 96;  // the highest level; at 0 the sector is blocked

  struct Sums {
    std::uint16_t beams = 0;
    std::uint16_t returns = 0;

    void add(bool is_beam, bool is_return);
    [[nodiscard]] bool are_below(std::uint32_t part) const { return part * returns < beams; }
  };
  static constexpr std::uint16_t kAllGave = 8192;

  [[nodiscard]] Kind kind_of(std::size_t sector);
  [[nodiscard]] std::size_t sector_of(std::uint32_t azimuth_ticks, std::size_t likely) const;
  [[nodiscard]] bool is_judged(std::size_t sector, std::uint8_t layer) const {
    return kinds_[sector] != Kind::kGround || (low_layers_[sector][layer / 64] >> layer % 64 & 1U);
  }
  [[nodiscard]] bool is_return(const lidar::ScanPoint& point) const;
  [[nodiscard]] bool is_over(std::uint32_t swept_ticks, std::uint64_t swept) const;
  [[nodiscard]] bool is_seen(std::size_t sector, std::uint64_t swept) const;
  [[nodiscard]] int level_after(std::size_t sector) const;

  const vehicle::Sensor* sensor_ = nullptr;
  const SectorView* view_ = nullptr;
  bool turns_ = false;
  std::array<Kind, kSectors> kinds_{};
  std::array<std::array<std::uint64_t, vehicle::kMaxLayers / 64>, kSectors> low_layers_{};
  std::array<std::uint8_t, kMaxSampled> sampled_{};
  std::uint8_t sampled_count_ = 0;

  std::array<Sums, kSectors> sums_{};  // of the turn at hand, of beams that are judged
  std::array<Sums, kSectors> all_{};   // and of all
  std::uint32_t turn_ticks_ = 0;       // swept of it before the frame at hand
  std::uint32_t turn_returns_ = 0;
  std::uint32_t frame_returns_ = 0;
  State state_{};
};

// A packet as it is fused: in silent azimuths a missing return is no evidence.
class EvidentPacket {
 public:
  EvidentPacket(const Packet& packet, const AzimuthParts& silent)
      : packet_(&packet), silent_(&silent) {}

  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    packet_->for_each_point([&](lidar::ScanPoint point) {
      if (point.range_mm == 0 && silent_->contain(point.azimuth_ticks)) {
        point.echo = 1;  // only the first echo of a beam carves
      }
      visit(point);
    });
  }
  template <typename Visit>
  void for_each_sample(const lidar::Sampling& sampling, Visit&& visit) const {
    packet_->for_each_sample(sampling, visit);
  }

 private:
  const Packet* packet_;
  const AzimuthParts* silent_;
};

}  // namespace iog::intake
