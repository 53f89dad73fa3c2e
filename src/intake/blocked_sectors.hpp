// Detects blocked sectors: sectors from which a sensor gets almost no returns although it should,
// because a cap, ice or mud covers its window, or because it is broken. Open sky gives no returns
// either. So each sector (watched_sectors.hpp) is judged by beams that must return:
//
// - ground: sectors of a spinning unit in which beams meet the car's plane within 20 m and at 1 in
//   16 or steeper (ground beams). A turn blocks the sector if both conditions hold. First, less
//   than a sixteenth of its ground beams return. Second, less than a sixteenth of all its beams
//   return, or at least a quarter of its ground beams used to (a running mean, 1/32 per turn). The
//   sector opens after three turns in which an eighth of its ground beams, or else of all its
//   beams, return.
// - sky: the other sectors of such a unit. They are blocked while all its ground sectors are.
// - level: sectors of a unit that does not spin or sees no ground, with a beam that rises by less
//   than 1 in 32. 32 scans without a return block the sector, and two with a return open it. Three
//   scans without any return block the whole unit.
//
// Returns nearer than the sensor's minimum do not count, nor do returns that it flags as dirt or
// rain. Only whole turns and scans are judged, by sums over packets, so the order of packets does
// not matter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "intake/packet.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

inline constexpr std::size_t kSectors = 64;

// The azimuths between which a sensor sees each sector. The width is 0 if it does not reach the
// sector.
using SectorView = std::array<lidar::Sector, kSectors>;

// A set of azimuths, in 256 parts of a turn.
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

// The blocked sectors of one sensor.
class BlockedSectors {
 public:
  // sensor and view must outlive it.
  BlockedSectors(const vehicle::Sensor& sensor, const SectorView& view);
  BlockedSectors() = default;

  // Adds a packet of the current frame.
  void add(const Packet& packet);

  // Whether the current frame has any return.
  [[nodiscard]] bool has_returns() const { return frame_returns_ > 0; }

  struct State {
    std::array<std::int16_t, kSectors> levels{};
    std::array<std::uint16_t, kSectors> gave{};  // mean share of ground beams that return
    std::uint8_t empty_turns = 0;
    // Bit i of seen: the sensor has looked into sector i since start. Bit i of blocked: it is
    // blocked there.
    std::uint64_t seen = 0;
    std::uint64_t blocked = 0;
  };

  // The state after the current frame, if the sensor swept this many ticks and these sectors in it.
  [[nodiscard]] State after_frame(std::uint32_t swept_ticks, std::uint64_t swept) const;
  // Closes the frame.
  void end_frame(std::uint32_t swept_ticks, std::uint64_t swept);

  // The azimuths of a packet in which a missing return is no evidence of free space: their sector
  // was blocked in earlier frames, or less than a sixteenth of the judged beams return in this
  // packet. The parts beside such azimuths count, too.
  [[nodiscard]] AzimuthParts silent_azimuths(const Packet& packet) const;

 private:
  enum class Kind : std::uint8_t { kUnseen, kGround, kLevel, kSky };
  static constexpr std::size_t kMaxSampled = 32;
  static constexpr std::int16_t kFull = 96;  // highest level; a sector at level 0 is blocked

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

  std::array<Sums, kSectors> sums_{};  // judged beams of the current turn
  std::array<Sums, kSectors> all_{};   // all beams of the current turn
  std::uint32_t turn_ticks_ = 0;       // swept in this turn before the current frame
  std::uint32_t turn_returns_ = 0;
  std::uint32_t frame_returns_ = 0;
  State state_{};
};

// A packet as fusion sees it: missing returns in silent azimuths are no evidence.
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
