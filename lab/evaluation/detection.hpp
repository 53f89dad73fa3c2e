// How much of what could be seen a grid says, and how much of what it says is so.
//
// Only cells that could be seen are scored. A range that is 10 cm off lies in the next cell, so
// each share comes twice: exact, and with a tolerance of one cell, under which a cell is right if
// it or one of its eight neighbours is (visibly so, or called so) as wanted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lab/evaluation/cell_state.hpp"

namespace iog::lab {

// Of one class, free or occupied. A share of nothing is 0.
struct ClassScore {
  std::uint64_t visible = 0;     // cells that are visibly of the class
  std::uint64_t found = 0;       // of these, those that the grid calls so
  std::uint64_t found_near = 0;  // of these, those of which the grid calls it or a neighbour so
  std::uint64_t called = 0;      // cells that the grid calls so and that are visibly anything
  std::uint64_t right = 0;       // of these, those that are visibly so
  std::uint64_t right_near = 0;  // of these, those of which it or a neighbour is visibly so

  [[nodiscard]] double recall() const;
  [[nodiscard]] double recall_near() const;
  [[nodiscard]] double precision() const;
  [[nodiscard]] double precision_near() const;

  ClassScore& operator+=(const ClassScore& other);
};

struct Detection {
  ClassScore occupied;
  ClassScore free;
  std::uint64_t missed = 0;       // visibly occupied cells that the grid calls free
  std::uint64_t missed_near = 0;  // of these, those without a neighbour that it calls occupied

  // Shares of the visibly occupied cells.
  [[nodiscard]] double miss_rate() const;
  [[nodiscard]] double miss_rate_near() const;

  // Of the visibly occupied and of the visibly free cells, the share that the grid knows at all.
  [[nodiscard]] double known_of_occupied() const;
  [[nodiscard]] double known_of_free() const;

  Detection& operator+=(const Detection& other);
};

// Both row by row, `stride` cells a row, of the same size.
[[nodiscard]] Detection compare(std::span<const CellState> truth, std::span<const CellState> grid,
                                std::size_t stride);

// What became of the cells in which a beam ended, each counted once.
struct EndedCells {
  std::uint64_t occupied = 0;
  std::uint64_t free = 0;  // a hit that the grid has lost
  std::uint64_t unknown = 0;

  [[nodiscard]] std::uint64_t all() const { return occupied + free + unknown; }
  // Shares of them that came out free and unknown.
  [[nodiscard]] double lost() const;
  [[nodiscard]] double left_unknown() const;

  EndedCells& operator+=(const EndedCells& other);
};

[[nodiscard]] EndedCells look_up(std::span<const std::uint32_t> hits,
                                 std::span<const CellState> grid);

}  // namespace iog::lab
