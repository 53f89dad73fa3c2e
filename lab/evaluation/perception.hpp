// How good the classes of a perception grid are: counts, of which pages make shares.
//
// A window is a square of cells, row by row from the lowest y; `side` cells a row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "geometry/cell.hpp"

namespace iog::lab {

// What a class byte says (docs/spec.md 3.9): classes of one meaning are one.
enum class Said : std::uint8_t { kUnknown, kFree, kMoving, kStanding, kOpen };
[[nodiscard]] constexpr Said said_by(std::int8_t class_byte) {
  constexpr std::array kSaid{Said::kUnknown,  Said::kFree,     Said::kFree,
                             Said::kFree,     Said::kMoving,   Said::kStanding,
                             Said::kStanding, Said::kStanding, Said::kOpen};
  return kSaid[static_cast<std::size_t>(class_byte) / 8];
}
[[nodiscard]] constexpr bool is_occupied(Said said) { return said >= Said::kMoving; }

// Cells by what is said of them.
struct SaidCounts {
  std::uint64_t unknown = 0;
  std::uint64_t free = 0;
  std::uint64_t moving = 0;
  std::uint64_t standing = 0;
  std::uint64_t open = 0;  // occupied, not yet known by what

  void add(Said said);
  [[nodiscard]] std::uint64_t all() const { return unknown + free + moving + standing + open; }
  SaidCounts& operator+=(const SaidCounts& other);
  friend bool operator==(const SaidCounts&, const SaidCounts&) = default;
};

// What was hit lately, and whether the grid keeps it.
//
// A cell counts if it was hit in one of the last kFrames frames, this one included, and if in at
// least kHits of them a cell of the 5 x 5 around it was hit. It is kept if one of the 5 x 5 is
// occupied: so within 0.2 m. Hits are given by place in the window, in frames that follow one
// another.
class RecentHits {
 public:
  static constexpr std::size_t kFrames = 12;
  static constexpr int kHits = 3;

  static constexpr std::size_t kKinds = 16;

  struct Hit {
    geometry::Cell cell{};  // of the local frame
    std::uint8_t kind = 0;  // of what was hit, as the caller says, 0 ... kKinds - 1
  };
  // Cells by the kind of their newest hit.
  struct Kept {
    std::array<std::uint64_t, kKinds> cells{};
    std::array<std::uint64_t, kKinds> kept{};
    std::array<std::uint64_t, kKinds> freed{};  // not kept, and called free; the others: unknown

    [[nodiscard]] std::uint64_t all_cells() const;
    [[nodiscard]] std::uint64_t all_kept() const;
    Kept& operator+=(const Kept& other);
  };

  void add_frame(std::vector<Hit> hits);
  void forget() { frames_.clear(); }

  // first: the window's lowest cell. Cells within two of the border do not count.
  [[nodiscard]] Kept compare(std::span<const std::int8_t> classes, std::size_t side,
                             geometry::Cell first) const;

 private:
  std::deque<std::vector<Hit>> frames_;  // the newest in front
};

// Cells between known ones: they are known, or have a known cell within `reach` cells to the left
// and to the right, or below and above.
struct GapCounts {
  std::uint64_t between = 0;
  std::uint64_t unknown = 0;
  GapCounts& operator+=(const GapCounts& other);
  friend bool operator==(const GapCounts&, const GapCounts&) = default;
};

// Which cells are looked at: those at least far_cells from the cell `middle`.
struct GapRange {
  std::size_t reach = 0;  // below 255
  geometry::Cell middle{};
  std::int32_t far_cells = 0;
};

// A value of 0 is unknown.
[[nodiscard]] GapCounts gaps_in(std::span<const std::int8_t> cells, std::size_t side,
                                const GapRange& range);

}  // namespace iog::lab
