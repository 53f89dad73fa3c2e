// The map cell by cell: whether a centre is inside of rings, and what it can be, by loops over all
// edges and all cells near by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "decision/decision.hpp"
#include "fakes/reference_block.hpp"
#include "map/block.hpp"
#include "map/raster.hpp"
#include "map/tile_mask.hpp"
#include "map/tile_place.hpp"

namespace iog::map {

// A block, and the bytes that it reads.
class WrittenBlock {
 public:
  explicit WrittenBlock(const tests::ReferenceBlock& map) : bytes_(map.bytes()), block_(bytes_) {}
  [[nodiscard]] const Block& block() const { return block_; }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
  Block block_;
};

using FineRing = std::vector<FinePoint>;

inline bool has(const FrameBits& bits, std::int32_t column, std::int32_t row) {
  return (bits.rows[static_cast<std::size_t>(row)] >> column & 1) != 0;
}

// By the definition of docs/map.md: the crossings of a row at or to the left of a point. A
// difference of coordinates is below 2^31, so no product overflows.
inline bool is_inside(const std::vector<FineRing>& rings, FinePoint point) {
  bool is_odd = false;
  for (const FineRing& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      FinePoint low = ring[i];
      FinePoint high = ring[(i + 1) % ring.size()];
      if (low.y > high.y) {
        std::swap(low, high);
      }
      if (low.y <= point.y && point.y < high.y) {
        const std::int64_t to_point =
            (std::int64_t{point.x} - low.x) * (high.y - std::int64_t{low.y});
        const std::int64_t to_edge =
            (std::int64_t{high.x} - low.x) * (point.y - std::int64_t{low.y});
        is_odd = is_odd != (to_point >= to_edge);
      }
    }
  }
  return is_odd;
}

// The centre of a cell of the frame.
inline FinePoint centre(std::int32_t column, std::int32_t row) {
  return {column * kFine + kFine / 2, row * kFine + kFine / 2};
}

// By cell of the frame the classes of its own.
using FrameClasses = std::array<std::array<std::uint8_t, kFrameSide>, kFrameSide>;

inline FrameClasses own_classes(const tests::ReferenceBlock& map, const TilePlace& place) {
  const auto fine = [&place](const tests::ReferenceRing& ring) {
    FineRing rounded;
    for (const PointCm point : ring) {
      rounded.push_back(place.fine(point));
    }
    return rounded;
  };
  FrameClasses classes{};
  const auto add = [&classes](const std::vector<FineRing>& rings, bool is_asked,
                              std::uint8_t what) {
    for (std::int32_t cell = 0; cell < kFrameSide * kFrameSide; ++cell) {
      const std::int32_t column = cell % kFrameSide;
      const std::int32_t row = cell / kFrameSide;
      if (is_inside(rings, centre(column, row)) == is_asked) {
        classes[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] |= what;
      }
    }
  };
  for (const tests::ReferenceFeature& feature : map.features) {
    std::vector<FineRing> rings;
    for (const tests::ReferenceRing& ring : feature.rings) {
      rings.push_back(fine(ring));
    }
    add(rings, true, static_cast<std::uint8_t>(feature.kind));
  }
  for (auto& row : classes) {
    for (std::uint8_t& cell : row) {
      cell = cell == 0 ? decision::kIntermediate : cell;
    }
  }
  add({fine(tests::rectangle(map.extent))}, false, decision::kAnywhere);
  return classes;
}

// The union over all cells whose centre is within the radius.
inline std::uint8_t within(const FrameClasses& own, std::int32_t x, std::int32_t y,
                           std::int32_t radius) {
  std::uint8_t classes = 0;
  for (std::int32_t dy = -radius; dy <= radius; ++dy) {
    for (std::int32_t dx = -radius; dx <= radius; ++dx) {
      if (dx * dx + dy * dy <= radius * radius) {
        classes |= own[static_cast<std::size_t>(y + dy)][static_cast<std::size_t>(x + dx)];
      }
    }
  }
  return classes;
}

// The classes of the tile's own cells.
using TileClasses = std::array<std::array<std::uint8_t, window::kTileSide>, window::kTileSide>;

inline TileClasses expected(const tests::ReferenceBlock& map, const TilePlace& place,
                            std::int32_t radius) {
  const FrameClasses own = own_classes(map, place);
  TileClasses classes{};
  for (std::int32_t y = 0; y < window::kTileSide; ++y) {
    for (std::int32_t x = 0; x < window::kTileSide; ++x) {
      classes[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] =
          within(own, x + kHalo, y + kHalo, radius);
    }
  }
  return classes;
}

inline TileClasses classes_of(const TileMask& mask) {
  TileClasses classes{};
  for (std::size_t y = 0; y < classes.size(); ++y) {
    for (std::size_t x = 0; x < classes.size(); ++x) {
      const auto bit = [x, y](const window::Plane& plane) { return plane[y] >> x & 1; };
      classes[y][x] = static_cast<std::uint8_t>(bit(mask.building) * decision::kBuilding +
                                                bit(mask.road) * decision::kRoad +
                                                bit(mask.intermediate) * decision::kIntermediate);
    }
  }
  return classes;
}

inline TileClasses classes_of(const window::TileRuledOut& ruled_out) {
  TileClasses classes{};
  for (std::size_t i = 0; i < geometry::kTileCells; ++i) {
    classes[i / window::kTileSide][i % window::kTileSide] =
        static_cast<std::uint8_t>(decision::kAnywhere & ~ruled_out[i / 8][i % 8]);
  }
  return classes;
}

}  // namespace iog::map
