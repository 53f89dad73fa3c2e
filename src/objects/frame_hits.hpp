// The hits of a frame in their order, which is the same in whatever order they came: by rings of
// tiles around the car, then by the window's slot, by cell, by slice.
//
// So the nearest come first wherever there is room for some only. If there are more than kMostSeen,
// whole rings are left out from the farthest on, and of the others those after kMostHits; a hit
// outside of the window or of no slice is none. All are counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/frame.hpp"
#include "objects/hit.hpp"
#include "objects/rules.hpp"
#include "window/area.hpp"

namespace iog::objects {

class FrameHits {
 public:
  static constexpr std::size_t kMostSeen = 2 * kMostHits;

  struct Left {
    std::uint32_t beyond = 0;  // there was no room
    std::uint32_t wrong = 0;   // outside of the window, or of no slice
    friend bool operator==(const Left&, const Left&) = default;
  };
  // Takes a frame's hits in place of those before. Of each, what the frame says of it is known.
  Left gather(const Frame& frame);

  [[nodiscard]] std::span<FrameHit> all() { return std::span(hits_).first(count_); }
  [[nodiscard]] std::span<const FrameHit> all() const { return std::span(hits_).first(count_); }

  // Whether one of the nine cells around a cell has a hit; a cell outside of the window has none.
  [[nodiscard]] bool is_hit_around(geometry::Cell cell) const;
  // The first hit of a cell of the window, of those in order; their number if the cell has none.
  [[nodiscard]] std::size_t first_of(geometry::Cell cell) const;

 private:
  // Bits from the highest: 5 of the ring, 10 of the slot, 10 of the cell in its tile, 5 of the
  // slice.
  using Key = std::uint32_t;

  static constexpr std::uint32_t kRings = 32;

  void begin(const Frame& frame);
  [[nodiscard]] geometry::Cell in_window(geometry::Cell cell) const;
  // Of a cell of the window, counted from its lowest.
  [[nodiscard]] std::uint32_t ring_of(geometry::Cell at) const;
  [[nodiscard]] static Key key_of(std::uint32_t ring, geometry::Cell cell, std::uint8_t slice);
  // Of cells of one row of one tile.
  [[nodiscard]] bool is_hit_between(geometry::Cell first, geometry::Cell last) const;
  void begin_hit(Key key, const Frame& frame, FrameHit& hit) const;
  [[nodiscard]] std::uint32_t rings_that_fit(const Frame& frame) const;
  std::size_t collect(const Frame& frame, Left& left);
  void sort(std::size_t count);

  window::Area area_{};
  // How many tiles a column of tiles is away from the car, and a row, from the lowest on.
  std::array<std::uint8_t, window::kTilesAcross> columns_away_{};
  std::array<std::uint8_t, window::kTilesAcross> rows_away_{};
  std::array<FrameHit, kMostHits> hits_{};
  std::size_t count_ = 0;
  std::array<Key, kMostSeen> keys_{};       // in order, of the hits first
  std::array<Key, kMostSeen + 1> other_{};  // as they come, and one that is too far
};

}  // namespace iog::objects
