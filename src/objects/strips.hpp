// Performs coarse tests of whether rectangles overlap, before exact distances are computed.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/plane.hpp"
#include "objects/rules.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// The columns and rows that a rectangle overlaps, with one bit per column or row. Each column or
// row is about 1 m wide. Columns whose numbers differ by a multiple of 32 share a bit. The same is
// true for rows. If two rectangles have no column or no row in common, they do not overlap.
struct Strips {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;

  // The rectangle is extended by `more_mm` on each side.
  [[nodiscard]] static constexpr Strips of(const Bounds& bounds, std::int32_t more_mm) {
    return {.columns = bits(bounds.low.x_mm - more_mm, bounds.high.x_mm + more_mm),
            .rows = bits(bounds.low.y_mm - more_mm, bounds.high.y_mm + more_mm)};
  }
  [[nodiscard]] constexpr bool may_meet(const Strips& other) const {
    // The test uses a single branch because two branches would be hard to predict.
    return std::min(columns & other.columns, rows & other.rows) != 0;
  }

 private:
  static constexpr int kStripBits = 10;

  [[nodiscard]] static constexpr std::uint32_t bits(std::int32_t low_mm, std::int32_t high_mm) {
    const std::int32_t first = low_mm >> kStripBits;
    const std::int32_t more = (high_mm >> kStripBits) - first;
    return more >= 31 ? ~std::uint32_t{0} : std::rotl((std::uint32_t{2} << more) - 1, first & 31);
  }
};

// The tracks that satisfy a condition, and their bounding rectangles. The selected tracks are
// numbered from 0 in the order of their slots.
class PlacedTracks {
 public:
  // Selects the tracks for which is_asked(track) is true. Extends the bounding rectangle of each
  // track by `more_mm` on each side.
  template <typename IsAsked>
  PlacedTracks(std::span<const Track> tracks, std::int32_t more_mm, IsAsked&& is_asked)
      : more_mm_(more_mm) {
    for (std::size_t slot = 0; slot < tracks.size(); ++slot) {
      if (is_asked(tracks[slot])) {
        slots_[count_] = static_cast<std::uint8_t>(slot);
        place(count_++, tracks[slot]);
      }
    }
  }
  // Updates the rectangle of a track that has moved or grown. The rectangle extends `reach_mm`
  // beyond the box.
  void place(std::size_t number, const Track& track, std::int32_t reach_mm = 0) {
    bounds_[number] = bounds_of(track.box()).grown(reach_mm);
    strips_[number] = Strips::of(bounds_[number], more_mm_);
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::uint8_t slot(std::size_t number) const { return slots_[number]; }
  [[nodiscard]] const Bounds& bounds(std::size_t number) const { return bounds_[number]; }
  [[nodiscard]] const Strips& strips(std::size_t number) const { return strips_[number]; }

  // Searches the tracks from number `from` onwards, and returns the number of the first one whose
  // strips may overlap the given strips. If there is no such track, returns count().
  [[nodiscard]] std::size_t next(const Strips& its, std::size_t from) const {
    while (from < count_ && !strips_[from].may_meet(its)) {
      ++from;
    }
    return from;
  }

 private:
  std::int32_t more_mm_;
  std::size_t count_ = 0;
  std::array<std::uint8_t, kMostTracks> slots_{};
  std::array<Bounds, kMostTracks> bounds_{};
  std::array<Strips, kMostTracks> strips_{};
};

}  // namespace iog::objects
