// The rule of open ground cell by cell on one flat grid: slow, and nothing shared with the rows of
// bits that do it in src/window.
//
// Outside of the grid nothing stands, is seen or shut. A cell outside of a rectangle that holds all
// freed cells is never shut, so a grid may be a part of what it is compared with.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/cell.hpp"

namespace iog::tests {

using geometry::Cell;

struct GroundCell {
  bool freed = false;
  bool seen = false;
  bool stands = false;
  bool taken = false;
  bool open = false;
  bool dense = false;
  int ticks = 0;
  bool is_hit = false;
  bool is_from_below = false;
  friend bool operator==(const GroundCell&, const GroundCell&) = default;
};

// How far the rule looks, in cells: at a standing thing, over gaps, and around open ground.
struct Looks {
  std::int32_t beside = 1;
  std::int32_t gaps = 2;
  std::int32_t open = 3;
};

class FlatGround {
 public:
  FlatGround(std::int32_t width, std::int32_t height, const Looks& looks = {})
      : area_{width, height},
        looks_(looks),
        cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  [[nodiscard]] const geometry::CellArea& area() const { return area_; }
  GroundCell& at(Cell cell) { return cells_[number(cell)]; }
  [[nodiscard]] GroundCell at(Cell cell) const {
    return area_.contains(cell) ? cells_[number(cell)] : GroundCell{};
  }

  // Asked of the state before a frame.
  [[nodiscard]] bool is_beside(Cell cell) const {
    return count(cell, looks_.beside, [](const GroundCell& near) { return near.stands; }) > 0;
  }
  [[nodiscard]] bool is_new(Cell cell) const {
    const GroundCell is = at(cell);
    return is.is_hit && is.open && is.freed && !is_beside(cell);
  }
  [[nodiscard]] bool has_moved(Cell cell) const {
    const GroundCell is = at(cell);
    if (!is.is_hit || is_beside(cell) || !(is.dense || is.open)) {
      return false;
    }
    return is.dense || count_new(cell) >= (is.ticks == 3 ? 2 : 7);
  }

  // Once before remembered(): freed, dilated and eroded by 5 by 5, without taken. What is dilated
  // reaches beyond the grid.
  void find_shut() {
    const auto is_grown = [this](Cell cell) {
      return count(cell, looks_.gaps, [](const GroundCell& near) { return near.freed; }) > 0;
    };
    std::vector<bool> grown(cells_.size());
    for_each([&](Cell cell) { grown[number(cell)] = is_grown(cell); });
    shut_.assign(cells_.size(), false);
    for_each([&](Cell cell) {
      shut_[number(cell)] = !at(cell).taken && everywhere(cell, looks_.gaps, [&](Cell near) {
        return area_.contains(near) ? grown[number(near)] : is_grown(near);
      });
    });
  }

  // What the cell remembers after the frame.
  [[nodiscard]] GroundCell remembered(Cell cell, bool is_new_period) const {
    GroundCell next = at(cell);
    if (is_beside(cell)) {
      next.open = next.dense = false;
      next.ticks = 0;
      return next;
    }
    const std::int32_t side = 2 * looks_.gaps + 1;
    next.dense |=
        count(cell, looks_.gaps, [](const GroundCell& near) { return near.seen; }) == side * side;
    if (is_shut_all_around(cell)) {
      next.open = true;
      next.ticks = std::min(next.ticks + (is_new_period ? 1 : 0), 3);
    }
    return next;
  }

 private:
  [[nodiscard]] std::size_t number(Cell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(area_.width) +
           static_cast<std::size_t>(cell.x);
  }

  // Whether it holds for all cells of the square around a cell; for none of those outside.
  template <typename Holds>
  static bool everywhere(Cell cell, std::int32_t radius, Holds&& holds) {
    for (std::int32_t y = cell.y - radius; y <= cell.y + radius; ++y) {
      for (std::int32_t x = cell.x - radius; x <= cell.x + radius; ++x) {
        if (!holds(Cell{x, y})) {
          return false;
        }
      }
    }
    return true;
  }

  template <typename Holds>
  [[nodiscard]] int count(Cell cell, std::int32_t radius, Holds&& holds) const {
    int count = 0;
    everywhere(cell, radius, [&](Cell near) {
      count += holds(at(near)) ? 1 : 0;
      return true;
    });
    return count;
  }
  [[nodiscard]] int count_new(Cell cell) const {
    int count = 0;
    everywhere(cell, looks_.open, [&](Cell near) {
      count += is_new(near) ? 1 : 0;
      return true;
    });
    return count;
  }

  [[nodiscard]] bool is_shut_all_around(Cell cell) const {
    return everywhere(cell, looks_.open,
                      [this](Cell near) { return area_.contains(near) && shut_[number(near)]; });
  }
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::int32_t y = 0; y < area_.height; ++y) {
      for (std::int32_t x = 0; x < area_.width; ++x) {
        visit(Cell{x, y});
      }
    }
  }

  geometry::CellArea area_;
  Looks looks_;
  std::vector<GroundCell> cells_;
  std::vector<bool> shut_;
};

}  // namespace iog::tests
