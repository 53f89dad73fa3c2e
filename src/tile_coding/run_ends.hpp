// Where the runs of a tile against a reference end, a row of 32 cells at a time.
//
// Call the cells from one change to the next a stretch. A run of a value ends with its stretch, so
// wherever a stretch ends in which a cell differs from the reference. A run "as in the reference"
// ends at the first such cell of a stretch, unless a value ended where the stretch begins: then the
// whole stretch is a run of its value.
#pragma once

#include <cstdint>

namespace iog::tile_coding {

// A flood of cells, row by row.
class Flood {
 public:
  constexpr explicit Flood(bool is_high) : last_{is_high ? 1U : 0U} {}

  // Goes on by a row. Flooded are the cells that are marked, and those that are open and follow a
  // flooded one. An addition finds them, because a carry runs through ones.
  constexpr void advance(std::uint32_t marked, std::uint32_t open) {
    const std::uint32_t ones = marked | open;
    behind_ = (ones + marked + last_) ^ ones ^ marked;
    flooded_ = marked | (open & behind_);
    last_ = flooded_ >> 31;
  }

  // Of the row: bit x for cell x, or for the cell before it.
  [[nodiscard]] constexpr std::uint32_t flooded() const { return flooded_; }
  [[nodiscard]] constexpr std::uint32_t behind() const { return behind_; }

  [[nodiscard]] constexpr bool last_is_flooded() const { return last_ != 0; }

 private:
  std::uint32_t flooded_ = 0;
  std::uint32_t behind_ = 0;
  std::uint32_t last_;
};

class RunEnds {
 public:
  // Bit x: a run ends before cell x. Never one of both kinds.
  struct Row {
    std::uint32_t of_values;
    std::uint32_t of_reference;
  };

  // Of the next row, by the bits of CellMap::mark_changes() and mark_differences().
  [[nodiscard]] constexpr Row next(std::uint32_t changes, std::uint32_t differences) {
    differing_.advance(differences, ~changes);
    const std::uint32_t of_values = changes & differing_.behind();
    begun_.advance(of_values, ~changes);
    return {.of_values = of_values,
            .of_reference = differences & ~(differing_.behind() | begun_.flooded())};
  }

  // Whether the run that goes to the end of the last row is one of a value.
  [[nodiscard]] constexpr bool last_is_value() const { return differing_.last_is_flooded(); }

 private:
  Flood differing_{false};  // from the first difference of a stretch to its end
  Flood begun_{true};       // stretches with which a run begins
};

}  // namespace iog::tile_coding
