// Fuses a frame's packets, either one after another on core 0 or in parallel on several cores. If
// several cores are used, they fuse the parts of the frame in any order and then join them.
//
//     packets -> [FrameParts] parts
//     packets of a part -> its core's fusion -> tiles of the part      task: a part
//                          tiles of all parts -> the frame's grid      task: a row of tiles
//
// A saturating sum of numbers with the same sign can be split in any way (fusion/joined_grid.hpp),
// so the assignment of parts to cores does not affect the result. If a core is lost while it fuses
// a part, another core can fuse this part again from the start. The lost core has written only to
// its own fusion, which is not used again, and to the slot of this part.
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

// Number of points per outcome.
using Fates = std::array<std::uint32_t, vehicle::kFateCount>;

// The maximum number of fused parts that have not been joined yet.
inline constexpr std::size_t kPartPlaces = FrameParts::kMostOfARound;

// The result of fusing one part, written by the core that fuses it.
struct FusedPart {
  Fates fates{};
  FrameTiles tiles;
};

// The additional memory for fusion on several cores. This memory consists of a FrameFusion for each
// helper, and slots for the results of the parts.
struct HelpersSpace {
  std::span<FrameFusion> fusions;
  std::span<FusedPart> parts;
};

// The additional memory for fusion on kCores cores. This memory takes up 74 MB for four cores and
// is empty for one core. A HelpersMemory must be in static memory.
template <std::size_t kCores>
class HelpersMemory {
 public:
  // `vehicle` must outlive this object.
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

// A SharedFusion uses 19 MB, so it must be in static memory.
class SharedFusion {
 public:
  // All arguments must outlive this object. `space` may be empty if core 0 works alone. Before a
  // frame's packets are fused, they must be added to `watched`.
  SharedFusion(const vehicle::Vehicle& vehicle, const intake::WatchedSectors& watched,
               HelpersSpace space);
  SharedFusion(const SharedFusion&) = delete;
  SharedFusion& operator=(const SharedFusion&) = delete;

  // Returns core 0's own FrameFusion, which is empty whenever the crew starts to fuse parts.
  [[nodiscard]] FrameFusion& own() { return own_; }

  // Returns the ground models, which change at the end of a frame.
  [[nodiscard]] const ground::Grounds& grounds() const { return grounds_; }

  // Returns how many points of the frame had each outcome.
  [[nodiscard]] const Fates& fates() const { return fates_; }

  // Adds a packet's points to core 0's own fusion.
  void fuse_alone(std::size_t sensor, const intake::Packet& packet) {
    add_points(own_, sensor, packet, fates_);
  }
  // Finishes core 0's own fusion and adds its grid to the frame's grid. Calls visit(tile, indexes,
  // low_and_tall) in the same way as FrameFusion::release_with_heights().
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

  // Returns the packets that are waiting to be fused.
  [[nodiscard]] FramePackets& packets() { return packets_; }
  void fuse_alone(std::size_t number) {
    fuse_alone(packets_.packets()[number].sensor, packets_.decoded(number));
  }
  // Fuses all buffered packets as one slice on the cores of the crew, and empties the buffer.
  void fuse_kept(const work::Crew& crew, std::size_t parts);
  // `deal()`, `fuse_next()` and `join()` are the steps of fuse_kept(). `deal()` splits the buffered
  // packets in the same way as FrameParts::deal().
  void deal(std::size_t groups, std::size_t parts) {
    parts_.deal(packets_.packets(), groups, parts);
  }
  // Fuses the parts of the next round. Returns false if no parts are left. If there are not enough
  // free slots, joins the parts of earlier rounds first.
  [[nodiscard]] bool fuse_next(const work::Crew& crew);

  // `round()` returns the parts of the last fused round, and tiles() returns their results. Both
  // are valid until the next round.
  [[nodiscard]] std::span<const FramePart> round() const { return round_; }
  [[nodiscard]] const FrameTiles& tiles(std::size_t part) const {
    return space_.parts[first_ + part].tiles;
  }

  // Adds the waiting parts to the frame's grid.
  void join(const work::Crew& crew);

  // Updates the estimated ground of each sensor that has completed a revolution. Call this function
  // after all packets of the frame have been fused.
  void end_frame(const intake::Intake& intake);

  // Visits the tiles of the frame's grid, and then clears the grid. The frame's grid is the joined
  // grid. If no parts were joined, it is core 0's own grid, which must be finished. Calls
  // visit(number, cells) for each tile with a known cell, in ascending order. place() returns the
  // bytes to which core 0's own grid may copy a tile's cells.
  template <typename Place, typename Visit>
  void release(Place&& place, Visit&& visit) {
    if (is_joined_) {
      joined_.release(visit);
    } else {
      own_.release_into(
          [&place](std::size_t /*tile*/) {
            const std::span<std::byte, geometry::kTileCells> bytes = place();
            return std::span<index::OccupancyIndex, geometry::kTileCells>(
                reinterpret_cast<index::OccupancyIndex*>(bytes.data()), bytes.size());
          },
          [&visit](std::size_t tile, auto indexes) { visit(tile, std::as_bytes(indexes)); });
    }
    is_joined_ = false;
  }
  // Begins the next frame. The grid must be cleared.
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

  // Members aligned to a cache line come first.
  FrameFusion own_;
  JoinedGrid joined_;
  health::Guard behind_joined_;
  ground::Grounds grounds_;  // used by the fusions of all cores
  health::Guard behind_grounds_;
  FramePackets packets_;
  health::Guard behind_packets_;
  const vehicle::Vehicle* vehicle_;
  const intake::WatchedSectors* watched_;
  HelpersSpace space_;
  Fates fates_{};
  FrameParts parts_;
  std::span<const FramePart> round_;
  std::size_t first_ = 0;    // slot of the round's first part
  std::size_t waiting_ = 0;  // number of parts waiting to be joined; they use the first slots
  bool is_joined_ = false;   // the frame's grid has content
};

}  // namespace iog::fusion
