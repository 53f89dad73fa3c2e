// Detects blocked sectors. In a blocked sector, a sensor gets almost no returns, although returns
// are expected. Possible causes are a cap, ice or mud on the sensor's window, and sensor defects.
// Beams into the open sky have no returns either. Each sector (watched_sectors.hpp) is therefore
// evaluated using only those beams for which a return is expected. There are ground, sky, level and
// open sectors.
//
// Ground sectors are the sectors of a spinning lidar with ground beams. Ground beams meet the car's
// plane within 20 m and with a slope of at least 1 in 16. For each ground sector, a running mean
// tracks the fraction of ground beams that have a return. Each turn updates the running mean with a
// weight of 1/32. A ground sector becomes blocked after a turn in which fewer than one sixteenth of
// its ground beams have a return. If the running mean is below one quarter, the sector becomes
// blocked only if fewer than one sixteenth of all its beams have a return. A ground sector is
// unblocked after three turns in which at least one eighth of its ground beams have a return. If
// the running mean is below one quarter, a turn also counts if at least one eighth of all beams in
// the sector have a return.
//
// Sky sectors are the other sectors of a unit that has ground or level sectors. Sky sectors are
// blocked while all ground and level sectors of the unit are blocked.
//
// Level sectors belong to units that do not spin or have no ground beams. In each level sector, at
// least one beam meets the car's plane within the unit's range. A level sector becomes blocked
// after 32 scans without a return, and is unblocked after two scans with a return. After three
// scans without any return, all sectors of the unit are reported as blocked.
//
// If no beam of a unit meets the car's plane within the unit's range, all sectors of the unit are
// open sectors. An example is a level 2D scanner. In open sectors, only beams that have an echo are
// evaluated. An open sector becomes blocked after 32 scans in which fewer than 1/16 of the echoes
// count as returns. An open sector is unblocked after two scans in which at least 1/16 of the
// echoes count as returns.
//
// Returns are ignored if they are closer than the sensor's minimum range or if the sensor flags
// them as dirt or rain. Only whole turns and scans are evaluated, as sums over their packets, so
// the order of packets does not matter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "intake/packet.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

inline constexpr std::size_t kSectors = 64;

// The azimuth interval in which a sensor sees each sector. The width of the interval is 0 if the
// sensor does not reach the sector.
using SectorView = std::array<lidar::Sector, kSectors>;

// A set of azimuths, in units of 1/256 turn.
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
  // `sensor` and `view` must outlive this object.
  BlockedSectors(const vehicle::Sensor& sensor, const SectorView& view);
  BlockedSectors() = default;

  // Adds a packet of the current frame.
  void add(const Packet& packet);

  // Returns true if the current frame has at least one return.
  [[nodiscard]] bool has_returns() const { return frame_returns_ > 0; }

  struct State {
    std::array<std::int16_t, kSectors> levels{};
    std::array<std::uint16_t, kSectors> gave{};  // mean fraction of ground beams with a return
    std::uint8_t empty_turns = 0;
    // Bit i of `seen` is set if the sensor has swept sector i since start. Bit i of `blocked` is
    // set if the sensor is blocked in sector i.
    std::uint64_t seen = 0;
    std::uint64_t blocked = 0;
  };

  // Returns the state after the current frame. In this frame, the sensor has swept `swept_ticks`
  // ticks and the sectors in `swept`.
  [[nodiscard]] State after_frame(std::uint32_t swept_ticks, std::uint64_t swept) const;
  // Ends the frame.
  void end_frame(std::uint32_t swept_ticks, std::uint64_t swept);

  // Returns the silent azimuths of a packet, at which a missing return is not evidence of free
  // space. An azimuth is silent if its sector was blocked at the end of the previous frame. An
  // azimuth is also silent if fewer than one sixteenth of the packet's evaluated beams at this
  // azimuth have a return. If the packet has no evaluated beams at an azimuth, the azimuth is
  // silent unless its sector is open. The result also includes the 1/256 turn on either side of
  // each silent azimuth.
  [[nodiscard]] AzimuthParts silent_azimuths(const Packet& packet) const;

 private:
  enum class Kind : std::uint8_t { kUnseen, kGround, kLevel, kSky, kOpen };
  static constexpr std::size_t kMaxSampled = 32;
  static constexpr std::int16_t kFull = 96;  // maximum level; a sector at level 0 is blocked

  // The counts of a frame fit into a word. What is kept for the next frame is limited to kMost.
  struct Sums {
    static constexpr std::uint32_t kMost = 65'535;
    std::uint32_t beams = 0;
    std::uint32_t returns = 0;

    void add(bool is_beam, bool is_return) {
      beams += is_beam ? 1U : 0U;
      returns += is_return ? 1U : 0U;
    }
    void keep_within_limits();
    [[nodiscard]] bool are_below(std::uint32_t part) const { return part * returns < beams; }
  };
  static constexpr std::uint16_t kAllGave = 8192;

  [[nodiscard]] Kind kind_of(std::size_t sector);
  void find_likely_sectors();
  [[nodiscard]] std::size_t sector_of(std::uint32_t azimuth_ticks) const;
  [[nodiscard]] bool is_judged(std::size_t sector, const lidar::ScanPoint& point) const {
    return kinds_[sector] == Kind::kGround
               ? (low_layers_[sector][point.layer / 32] >> point.layer % 32 & 1U) != 0
               : kinds_[sector] != Kind::kOpen || point.range_mm != 0;
  }
  [[nodiscard]] bool is_return(const lidar::ScanPoint& point) const;
  [[nodiscard]] bool is_decided(std::size_t sector) const;
  [[nodiscard]] bool is_over(std::uint32_t swept_ticks, std::uint64_t swept) const;
  template <typename Visit>
  void for_each_seen(std::uint64_t swept, Visit&& visit) const;
  [[nodiscard]] int level_after(std::size_t sector) const;

  const vehicle::Sensor* sensor_ = nullptr;
  const SectorView* view_ = nullptr;
  bool turns_ = false;
  std::array<Kind, kSectors> kinds_{};
  // Bit i of `reached_` is set if the sensor reaches sector i. `judged_` has those of these bits
  // whose sectors are no sky sectors.
  std::uint64_t reached_ = 0;
  std::uint64_t judged_ = 0;
  std::array<std::array<std::uint32_t, vehicle::kMaxLayers / 32>, kSectors> low_layers_{};
  // The sector in which the search for an azimuth begins, by intervals of 2^likely_shift_ ticks.
  static constexpr std::size_t kLikely = 256;
  std::array<std::uint8_t, kLikely> likely_{};
  std::uint8_t likely_shift_ = 0;
  std::array<std::uint8_t, kMaxSampled> sampled_{};
  std::uint8_t sampled_count_ = 0;

  std::array<Sums, kSectors> sums_{};  // evaluated beams of the current turn
  std::array<Sums, kSectors> all_{};   // all beams of the current turn
  std::uint32_t turn_ticks_ = 0;       // ticks swept in this turn before the current frame
  std::uint32_t turn_returns_ = 0;
  std::uint32_t frame_returns_ = 0;
  State state_{};
};

// Passes the points of a packet to the fusion code. At silent azimuths, a missing return is not
// evidence of free space.
class EvidentPacket {
 public:
  EvidentPacket(const Packet& packet, const AzimuthParts& silent)
      : packet_(&packet), silent_(&silent) {}

  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    visit_points(&visit, [](void* its, const lidar::ScanPoint& point) {
      (*static_cast<std::remove_reference_t<Visit>*>(its))(point);
    });
  }
  template <typename Visit>
  void for_each_sample(const lidar::Sampling& sampling, Visit&& visit) const {
    packet_->for_each_sample(sampling, visit);
  }

 private:
  // Calls visit(its, point) for each point. Few cars need this class, so that the decoding of each
  // format is compiled once, and not for each kind of visit.
  void visit_points(void* its, void (*visit)(void* its, const lidar::ScanPoint& point)) const;

  const Packet* packet_;
  const AzimuthParts* silent_;
};

}  // namespace iog::intake
