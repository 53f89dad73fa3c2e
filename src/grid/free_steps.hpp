// How free the waiting beams of one line make its cells: a step function along the line.
//
// All beams of one line carve the same cells, each up to its own end. What they say of a cell is a
// negative index, and adding negative indexes commutes under saturation (docs/model.md section 3).
// To add a and then b, each with a floor at -127, is to add a + b with that floor. So the sum of
// the beams is carved in one walk. Two beams of a LUX, the nearer with its scan point at a, the
// other at b:
//
//     freer by  28 ----------+
//                            +- 21 -+
//                                   +- 14 ---------------+
//                                                        +- 7 -+
//                                                              +- 0
//     the line   S ---------------------- a -------------------------- b ----> E
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sensor_model/profile.hpp"
#include "traversal/line.hpp"

namespace iog::grid {

// A point between two cells of a line: before the cell at this position, or just after it.
struct Between {
  traversal::Position at;
  bool is_after = false;

  // A cell of the line lies before this point if fewer borders are crossed to get there.
  [[nodiscard]] constexpr std::uint32_t crossed() const {
    return at.crossed() + (is_after ? 1U : 0U);
  }
};

class FreeSteps {
 public:
  // A step: from here on, cells are freer by so much; if that is below 0, less free.
  struct Change {
    std::uint32_t crossed = 0;  // Between::crossed()
    traversal::Position at;     // Between::at; after it if more borders are crossed than there
    std::int32_t freer = 0;
  };

  // A beam makes a change where each of its zones before the hit begins, and one at the end of the
  // last.
  static constexpr std::size_t kMaxChangesOfABeam = sensor_model::kMaxNearCells + 2;

  [[nodiscard]] bool has_room() const { return count_ + kMaxChangesOfABeam <= kMaxChanges; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  void clear() {
    count_ = 0;
    from_start_ = 0;
  }

  // Makes the line freer from its start on. The beam's other changes follow.
  void add_from_start(std::int32_t freer) { from_start_ += freer; }

  // Adds a change. Only if has_room() was true before the beam. Changes mostly come in order, so
  // the place of a new one is searched from the end.
  void add(Between from, std::int32_t freer) {
    const std::uint32_t crossed = from.crossed();
    Change* place = &changes_[count_];
    for (; place != changes_.data() && place[-1].crossed >= crossed; --place) {
      if (place[-1].crossed == crossed) {
        place[-1].freer += freer;
        return;
      }
    }
    for (Change* last = &changes_[count_]; last != place; --last) {
      last[0] = last[-1];
    }
    *place = {crossed, from.at, freer};
    ++count_;
  }

  // How much freer the line is from its start on, and the changes after that, in order. After the
  // last one nothing is left to carve.
  [[nodiscard]] std::int32_t from_start() const { return from_start_; }
  [[nodiscard]] std::span<const Change> changes() const {
    return std::span(changes_).first(count_);
  }

 private:
  static constexpr std::size_t kMaxChanges = 32;

  std::size_t count_ = 0;
  std::int32_t from_start_ = 0;
  std::array<Change, kMaxChanges> changes_{};
};

}  // namespace iog::grid
