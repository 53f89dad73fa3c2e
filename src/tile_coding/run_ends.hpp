// Where the runs of a tile end that is coded against a reference, for a row of 32 cells at a time.
//
// A *stretch* is the cells from one change of value to the next. There are two kinds of run:
//
//   of a value           ends at the end of its stretch. There is one in every stretch in which a
//                        cell differs from the reference.
//   as in the reference  may span many stretches. It ends at the first cell that differs; there a
//                        run of that cell's value begins, in the middle of the stretch.
//
// There is one exception. If a run of a value ends where a stretch begins, and a cell of that
// stretch differs, the whole stretch is a run of its own value: no run "as in the reference" is put
// before the first cell that differs.
#pragma once

#include <cstdint>

namespace iog::tile_coding {

// Spreads marks along the cells, row by row, like water that runs until it meets a wall.
class Flood {
 public:
  constexpr explicit Flood(bool is_high) : last_{is_high ? 1U : 0U} {}

  // Takes the next row. A cell is flooded if it is marked, or if it is open and follows a flooded
  // one. One addition finds all of them, because a carry runs through ones.
  constexpr void advance(std::uint32_t marked, std::uint32_t open) {
    const std::uint32_t ones = marked | open;
    behind_ = (ones + marked + last_) ^ ones ^ marked;
    flooded_ = marked | (open & behind_);
    last_ = flooded_ >> 31;
  }

  // Of this row. Bit x of flooded() is cell x; bit x of behind() is the cell before x.
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
  // Bit x: a run of this kind ends before cell x. Both kinds never end at one place.
  struct Row {
    std::uint32_t of_values;
    std::uint32_t of_reference;
  };

  // The run ends of the next row. The arguments are its rows of CellMap::mark_changes() and
  // mark_differences().
  [[nodiscard]] constexpr Row next(std::uint32_t changes, std::uint32_t differences) {
    differing_.advance(differences, ~changes);
    const std::uint32_t of_values = changes & differing_.behind();
    begun_.advance(of_values, ~changes);
    return {.of_values = of_values,
            .of_reference = differences & ~(differing_.behind() | begun_.flooded())};
  }

  // Whether the run that reaches the end of the last row is a run of a value.
  [[nodiscard]] constexpr bool last_is_value() const { return differing_.last_is_flooded(); }

 private:
  Flood differing_{false};  // from the first difference of a stretch to its end
  Flood begun_{true};       // stretches with which a run begins
};

}  // namespace iog::tile_coding
