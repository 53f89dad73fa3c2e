// Sorts the hits of a frame so that the result does not depend on the order of arrival. The sort
// keys are the ring of tiles around the car, the window slot, the cell and the slice.
//
// The nearest hits come first, so the farthest hits are dropped if a frame has too many. If a frame
// has more than kMostSeen hits, complete rings are dropped, starting with the farthest one. If more
// than kMostHits hits remain, hits at the end of the sorted list are dropped. Hits outside the
// window or with an invalid slice are rejected. All dropped and rejected hits are counted.
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
    std::uint32_t beyond = 0;  // dropped because there were too many hits
    std::uint32_t wrong = 0;   // outside the window, or with an invalid slice
    friend bool operator==(const Left&, const Left&) = default;
  };
  // Replaces the stored hits with the hits of a frame. Members of a FrameHit that cannot be
  // computed from the frame alone are set to default values.
  Left gather(const Frame& frame);

  [[nodiscard]] std::span<FrameHit> all() { return std::span(hits_).first(count_); }
  [[nodiscard]] std::span<const FrameHit> all() const { return std::span(hits_).first(count_); }

  // Returns true if a cell or any of its eight neighbours has a hit. Cells outside the window have
  // no hits.
  [[nodiscard]] bool is_hit_around(geometry::Cell cell) const;
  // Returns the index of the first hit of a window cell. If the cell has no hit, returns the number
  // of hits.
  [[nodiscard]] std::size_t first_of(geometry::Cell cell) const;

 private:
  // From the highest bit to the lowest, the key consists of 5 bits for the ring, 10 bits for the
  // slot, 10 bits for the cell in the tile, and 5 bits for the slice.
  using Key = std::uint32_t;

  static constexpr std::uint32_t kRings = 32;

  void begin(const Frame& frame);
  [[nodiscard]] geometry::Cell in_window(geometry::Cell cell) const;
  // `at` is a cell of the window, relative to the window's lowest cell.
  [[nodiscard]] std::uint32_t ring_of(geometry::Cell at) const;
  [[nodiscard]] static Key key_of(std::uint32_t ring, geometry::Cell cell, std::uint8_t slice);
  // Both cells must be in the same row of the same tile.
  [[nodiscard]] bool is_hit_between(geometry::Cell first, geometry::Cell last) const;
  void begin_hit(Key key, const Frame& frame, FrameHit& hit) const;
  [[nodiscard]] std::uint32_t rings_that_fit(const Frame& frame) const;
  std::size_t collect(const Frame& frame, Left& left);
  void sort(std::size_t count);

  window::Area area_{};
  // The distances of the tile columns and tile rows from the car, in tiles. The lowest column and
  // row come first.
  std::array<std::uint8_t, window::kTilesAcross> columns_away_{};
  std::array<std::uint8_t, window::kTilesAcross> rows_away_{};
  std::array<FrameHit, kMostHits> hits_{};
  std::size_t count_ = 0;
  std::array<Key, kMostSeen> keys_{};       // in order; the first count_ belong to hits_
  std::array<Key, kMostSeen + 1> other_{};  // in order of arrival, plus one entry that is too far
                                            // away
};

}  // namespace iog::objects
