// Parts of a frame's packets, each fused by whichever core takes it, and their join.
//
//     packets of a part -> any core's fusion -> tiles of the part      a part an item
//                          tiles of all parts -> the frame's grid      a row of tiles an item
//
// Saturated sums of one sign do not mind in which grid they were begun (grid/joined_grid.hpp), so
// which core has which part does not show. A part that a core has left can be fused again from its
// start: what it wrote is its core's fusion, which nobody uses again, and its own place here.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "app/frame_engine.hpp"
#include "app/frame_packets.hpp"
#include "app/frame_parts.hpp"
#include "grid/frame_tiles.hpp"
#include "grid/joined_grid.hpp"
#include "hal/cores.hpp"
#include "work/crew.hpp"

namespace iog::app {

// Holds 65 MB: belongs into static memory.
class PartsFusion {
 public:
  // So many parts can be there at once.
  static constexpr std::size_t kPlaces = FrameParts::kMostOfARound;

  // vehicle outlives it.
  explicit PartsFusion(const vehicle::Vehicle& vehicle)
      : fusions_{grid::FrameFusion(vehicle), grid::FrameFusion(vehicle),
                 grid::FrameFusion(vehicle)},
        vehicle_(&vehicle) {}

  // Fuses parts of these packets, by core 0 in its frame's fusion, which is clear before and after,
  // and counts their points there. They take the places from `first` on.
  void fuse(const work::Crew& crew, const FrameParts& dealt, std::span<const FramePart> parts,
            FramePackets& packets, FrameEngine& frame, std::size_t first = 0);

  // How many cells the points of the parts in these places have marked.
  [[nodiscard]] std::size_t marks(std::size_t first, std::size_t count) const;

  // Adds the parts in the first places to a grid. If nothing has been added to it before, what is
  // there is of nobody who has ended his item, and is forgotten; else adding cannot be done again
  // from its start, and core 0 does it alone.
  void join(const work::Crew& crew, std::size_t count, grid::JoinedGrid& grid, bool is_first) const;

  // The tiles of the part in this place.
  [[nodiscard]] const grid::FrameTiles& tiles(std::size_t place) const {
    return results_[place].tiles;
  }

 private:
  // What fusing a part makes. Whoever does it writes it.
  struct Result {
    FrameEngine::Fates fates{};
    std::size_t marks = 0;
    grid::FrameTiles tiles;
  };

  void fuse_part(std::span<const std::uint16_t> numbers, FramePackets& packets,
                 grid::FrameFusion& fusion, Result& result) const;
  void join_row(std::size_t row, std::size_t count, grid::JoinedGrid& grid, bool is_first) const;

  std::array<grid::FrameFusion, hal::kMaxCores - 1> fusions_;  // of the helpers
  std::array<Result, kPlaces> results_{};
  const vehicle::Vehicle* vehicle_;
};

}  // namespace iog::app
