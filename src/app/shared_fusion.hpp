// The fusion of a frame's packets by several cores, in parts, each fused by whichever core takes
// it, and the join of the parts.
//
//     packets -> [FrameParts] parts
//     packets of a part -> its core's fusion -> tiles of the part      a part an item
//                          tiles of all parts -> the frame's grid      a row of tiles an item
//
// Saturated sums of one sign do not mind in which grid they were begun (grid/joined_grid.hpp), so
// which core has which part does not show. A part that a lost core has begun can be fused again
// from its start: what was written is that core's fusion, which is not used again, and the part's
// place.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "app/frame.hpp"
#include "app/frame_packets.hpp"
#include "app/frame_parts.hpp"
#include "grid/frame_fusion.hpp"
#include "grid/frame_tiles.hpp"
#include "grid/joined_grid.hpp"
#include "ground/ground.hpp"
#include "hal/cores.hpp"
#include "health/guard.hpp"
#include "vehicle/vehicle.hpp"
#include "work/crew.hpp"

namespace iog::app {

// So many parts can wait to be joined.
inline constexpr std::size_t kPartPlaces = FrameParts::kMostOfARound;

// The result of a part, written by the core that fuses it.
struct FusedPart {
  Fates fates{};
  grid::FrameTiles tiles;
};

// What sharing takes of memory beside core 0's own: a fusion for each helper, and the places.
struct HelpersSpace {
  std::span<grid::FrameFusion> fusions;
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
    for (grid::FrameFusion& fusion : fusions_) {
      fusion.for_each_guard(visit);
    }
    if constexpr (kCores > 1) {
      visit(behind_parts_);
    }
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    for (const grid::FrameFusion& fusion : fusions_) {
      fusion.for_each_constant(visit);
    }
  }

 private:
  template <std::size_t... kHelper>
  HelpersMemory(const vehicle::Vehicle& vehicle, std::index_sequence<kHelper...> /*helpers*/)
      : fusions_{(static_cast<void>(kHelper), grid::FrameFusion(vehicle))...} {}

  std::array<grid::FrameFusion, kCores - 1> fusions_;
  std::array<FusedPart, kCores == 1 ? 0 : kPartPlaces> parts_{};
  health::Guard behind_parts_;
};

// Holds 17 MB: belongs into static memory.
class SharedFusion {
 public:
  // vehicle and space outlive it. Without space core 0 has to be alone.
  SharedFusion(const vehicle::Vehicle& vehicle, HelpersSpace space);
  SharedFusion(const SharedFusion&) = delete;
  SharedFusion& operator=(const SharedFusion&) = delete;

  // Core 0's own fusion. It is clear whenever the crew fuses.
  [[nodiscard]] grid::FrameFusion& own() { return own_; }

  // Deals out packets, as FrameParts::deal().
  void deal(FramePackets& packets, std::size_t groups, std::size_t parts);

  // Fuses the parts of the next round, and counts their points in the frame. False if there are
  // none. Parts of rounds before that found no place any more are joined.
  [[nodiscard]] bool fuse_next(const work::Crew& crew, Frame& frame);

  // The parts of that round, and what became of each of them, until the next one.
  [[nodiscard]] std::span<const FramePart> round() const { return round_; }
  [[nodiscard]] const grid::FrameTiles& tiles(std::size_t part) const {
    return space_.parts[first_ + part].tiles;
  }

  // Adds the parts that wait to the frame's grid.
  void join(const work::Crew& crew);

  // All of the frame's packets were fused: the ground is renewed of sensors whose turn is over.
  void end_frame(const Frame& frame);

  // The frame's grid, of what was joined. Its release begins another frame.
  [[nodiscard]] grid::JoinedGrid& joined() { return joined_; }
  template <typename Visit>
  void release(Visit&& visit) {
    joined_.release(visit);
    is_joined_ = false;
  }

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    own_.for_each_guard(visit);
    visit(behind_joined_);
    visit(behind_grounds_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    own_.for_each_constant(visit);
    grounds_.for_each_constant(visit);
    health::visit_constants(visit, vehicle_, space_);
  }

 private:
  void fuse_part(const FramePart& part, grid::FrameFusion& fusion, FusedPart& fused,
                 const Frame& frame) const;
  void join_row(std::size_t row, bool is_first);
  void join_lows(std::size_t place);
  void clear_lows(std::size_t place);

  // What is aligned to a cache line comes first.
  grid::FrameFusion own_;
  grid::JoinedGrid joined_;
  health::Guard behind_joined_;
  ground::Grounds grounds_;  // that all cores' fusions follow
  health::Guard behind_grounds_;
  const vehicle::Vehicle* vehicle_;
  HelpersSpace space_;
  FramePackets* packets_ = nullptr;
  FrameParts parts_;
  std::span<const FramePart> round_;
  std::size_t first_ = 0;    // the place of its first part
  std::size_t waiting_ = 0;  // parts that wait, in the first places
  bool is_joined_ = false;   // something of the frame is in its grid
};

}  // namespace iog::app
