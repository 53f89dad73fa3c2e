// The fusion of a frame's packets: by core 0 alone, one after the other; or by several cores, in
// parts, each fused by whichever core takes it, and the join of the parts.
//
//     packets -> [FrameParts] parts
//     packets of a part -> its core's fusion -> tiles of the part      a part an item
//                          tiles of all parts -> the frame's grid      a row of tiles an item
//
// Saturated sums of one sign do not mind in which grid they were begun (fusion/joined_grid.hpp), so
// which core has which part does not show. A part that a lost core has begun can be fused again
// from its start: what was written is that core's fusion, which is not used again, and the part's
// place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "fusion/frame_fusion.hpp"
#include "fusion/frame_packets.hpp"
#include "fusion/frame_parts.hpp"
#include "fusion/frame_tiles.hpp"
#include "fusion/joined_grid.hpp"
#include "ground/ground.hpp"
#include "hal/cores.hpp"
#include "health/guard.hpp"
#include "intake/intake.hpp"
#include "intake/packet.hpp"
#include "intake/watched_sectors.hpp"
#include "vehicle/vehicle.hpp"
#include "work/crew.hpp"

namespace iog::fusion {

// How many points had which fate.
using Fates = std::array<std::uint32_t, vehicle::kFateCount>;

// So many parts can wait to be joined.
inline constexpr std::size_t kPartPlaces = FrameParts::kMostOfARound;

// The result of a part, written by the core that fuses it.
struct FusedPart {
  Fates fates{};
  FrameTiles tiles;
};

// What sharing takes of memory beside core 0's own: a fusion for each helper, and the places.
struct HelpersSpace {
  std::span<FrameFusion> fusions;
  std::span<FusedPart> parts;
};

// As much of it as so many cores need: 74 MB for four, nothing for one. Belongs into static memory.
template <std::size_t kCores>
class HelpersMemory {
 public:
  // vehicle outlives it.
  explicit HelpersMemory(const vehicle::Vehicle& vehicle)
      : HelpersMemory(vehicle, std::make_index_sequence<kCores - 1>()) {}

  [[nodiscard]] HelpersSpace space() { return {fusions_, parts_}; }

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    for (FrameFusion& fusion : fusions_) {
      fusion.for_each_guard(visit);
    }
    if constexpr (kCores > 1) {
      visit(behind_parts_);
    }
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    for (const FrameFusion& fusion : fusions_) {
      fusion.for_each_constant(visit);
    }
  }

 private:
  template <std::size_t... kHelper>
  HelpersMemory(const vehicle::Vehicle& vehicle, std::index_sequence<kHelper...> /*helpers*/)
      : fusions_{(static_cast<void>(kHelper), FrameFusion(vehicle))...} {}

  std::array<FrameFusion, kCores - 1> fusions_;
  std::array<FusedPart, kCores == 1 ? 0 : kPartPlaces> parts_{};
  health::Guard behind_parts_;
};

// Holds 19 MB: belongs into static memory.
class SharedFusion {
 public:
  // They outlive it. Without space core 0 has to be alone. watched: with this frame's packets.
  SharedFusion(const vehicle::Vehicle& vehicle, const intake::WatchedSectors& watched,
               HelpersSpace space);
  SharedFusion(const SharedFusion&) = delete;
  SharedFusion& operator=(const SharedFusion&) = delete;

  // Core 0's own fusion. It is clear whenever the crew fuses.
  [[nodiscard]] FrameFusion& own() { return own_; }

  // What has become of the frame's points.
  [[nodiscard]] const Fates& fates() const { return fates_; }

  // Adds a packet's points to core 0's own fusion.
  void fuse_alone(std::size_t sensor, const intake::Packet& packet) {
    add_points(own_, sensor, packet, fates_);
  }
  // That is finished and becomes a part of the frame's grid: visit(tile, indexes, low_and_tall) as
  // of FrameFusion::release_with_heights().
  template <typename Visit>
  void join_alone(Visit&& visit) {
    own_.finish();
    own_.release_with_heights(
        [&](std::size_t tile, auto indexes, const grid::TileBits& low_and_tall) {
          joined_.add(tile, indexes);
          visit(tile, indexes, low_and_tall);
        });
    is_joined_ = true;
  }

  // Packets that are kept until they are fused, by the crew.
  [[nodiscard]] FramePackets& packets() { return packets_; }
  void fuse_alone(std::size_t number) {
    fuse_alone(packets_.packets()[number].sensor, packets_.decoded(number));
  }
  // All of them as one slice, so many parts; then none are kept.
  void fuse_kept(const work::Crew& crew, std::size_t parts);
  // Or step by step: deals them out, as FrameParts::deal().
  void deal(std::size_t groups, std::size_t parts) {
    parts_.deal(packets_.packets(), groups, parts);
  }
  // Fuses the parts of the next round. False if there are none. Parts of rounds before that found
  // no place any more are joined.
  [[nodiscard]] bool fuse_next(const work::Crew& crew);

  // The parts of that round, and what became of each of them, until the next one.
  [[nodiscard]] std::span<const FramePart> round() const { return round_; }
  [[nodiscard]] const FrameTiles& tiles(std::size_t part) const {
    return space_.parts[first_ + part].tiles;
  }

  // Adds the parts that wait to the frame's grid.
  void join(const work::Crew& crew);

  // All of the frame's packets were fused: the ground is renewed of sensors whose turn is over.
  void end_frame(const intake::Intake& intake);

  // The frame's grid: what was joined, or without that core 0's own, which is finished. Calls
  // visit(number, cells) for each tile in which something is known, in rising order, and clears it.
  template <typename Visit>
  void release(Visit&& visit) {
    if (is_joined_) {
      joined_.release(visit);
    } else {
      own_.release(
          [&visit](std::size_t tile, auto indexes) { visit(tile, std::as_bytes(indexes)); });
    }
    is_joined_ = false;
  }
  // The grid is clear; another frame begins.
  void start_next() {
    packets_.clear();
    fates_ = {};
  }

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    own_.for_each_guard(visit);
    visit(behind_joined_);
    visit(behind_grounds_);
    visit(behind_packets_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    own_.for_each_constant(visit);
    grounds_.for_each_constant(visit);
    health::visit_constants(visit, vehicle_, space_);
  }

 private:
  void add_points(FrameFusion& fusion, std::size_t sensor, const intake::Packet& packet,
                  Fates& fates) const;
  void fuse_part(const FramePart& part, FrameFusion& fusion, FusedPart& fused) const;
  void join_row(std::size_t row, bool is_first);
  void join_lows(std::size_t place);
  void clear_lows(std::size_t place);

  // What is aligned to a cache line comes first.
  FrameFusion own_;
  JoinedGrid joined_;
  health::Guard behind_joined_;
  ground::Grounds grounds_;  // that all cores' fusions follow
  health::Guard behind_grounds_;
  FramePackets packets_;
  health::Guard behind_packets_;
  const vehicle::Vehicle* vehicle_;
  const intake::WatchedSectors* watched_;
  HelpersSpace space_;
  Fates fates_{};
  FrameParts parts_;
  std::span<const FramePart> round_;
  std::size_t first_ = 0;    // the place of its first part
  std::size_t waiting_ = 0;  // parts that wait, in the first places
  bool is_joined_ = false;   // something of the frame is in its grid
};

}  // namespace iog::fusion
