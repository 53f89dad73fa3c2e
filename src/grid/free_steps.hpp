// A step function along a line. The function specifies the amount by which the line's pending beams
// lower each cell.
//
// All beams of a line carve the same cells, but each beam stops at its own end. Each beam adds a
// negative index to a cell. Saturating additions of negative indexes commute (docs/model.md section
// 3). Adding x and then y, with each sum clamped at -127, has the same result as adding x + y and
// clamping once. The sum of the beams can therefore be carved in one pass. The example shows two
// beams of a LUX. The nearer beam ends at `a`, and the farther beam ends at `b`. Each number is the
// amount by which the indexes of the cells are lowered:
//
//    lowered by 28 ----------+
//                            +- 21 -+
//                                   +- 14 ---------------+
//                                                        +- 7 -+
//                                                              +- 0
//     the line   S ---------------------- a -------------------------- b ----> E
//
// The function is stored as a difference array. Slot n contains the change that occurs n borders
// after the line enters the grid. A bitmap marks the slots in use. A change can therefore be added
// without a search, and scanning the bitmap yields the changes in order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "geometry/grid.hpp"
#include "grid/line_part.hpp"
#include "index/occupancy_index.hpp"

namespace iog::grid {

class FreeSteps {
 public:
  // A line crosses at most `kSlots - 2` cell borders. The border after its last cell can add one
  // more.
  static constexpr std::size_t kSlots = std::size_t{2} * geometry::kCellsPerSide;

  static constexpr std::uint32_t kMaxBeams = 256;

  // Sets the point where the line enters the grid. Call this function only while no beams are
  // pending.
  void begin_at(Between first) {
    first_ = first;
    last_ = first;
  }

  // Each beam changes the amount by less than 2^7, and a slot can store values below 2^15.
  [[nodiscard]] bool has_room() const { return beam_count_ < kMaxBeams; }

  // To add a beam, call begin_beam() with the first amount, then add() for each later change, and
  // then end_beam(). Add a beam only if has_room() returns true. Between its entry into the
  // grid and each change, the line must cross fewer than 2 * kCellsPerSide cell borders.
  void begin_beam(Between from, std::int32_t freer) {
    ++beam_count_;
    add(from, freer);
  }
  void end_beam(Between end) { last_ = std::max(last_, end); }
  // Adds `count` beams that begin where the line enters the grid.
  void add_beams(std::uint32_t count, std::int32_t freer, Between last_end) {
    beam_count_ += count;
    from_start_ += static_cast<std::int32_t>(count) * freer;
    end_beam(last_end);
  }
  void add(Between from, std::int32_t freer) {
    if (from.crossed() == first_.crossed()) {
      from_start_ += freer;
      return;
    }
    const std::uint32_t number = from.crossed() - first_.crossed();
    std::uint32_t& slot = slots_[number];
    slot = ((slot + static_cast<std::uint32_t>(freer)) & 0xFFFFU) | from.bits() << 16;
    map_[number / 32] |= kFirstBit >> number % 32;
  }

  [[nodiscard]] bool is_empty() const { return beam_count_ == 0; }

  // `from_start()` returns the amount carved where the line enters the grid. `last()` returns the
  // point of the last change. Cells beyond this point are not carved.
  [[nodiscard]] std::int32_t from_start() const { return from_start_; }
  [[nodiscard]] Between last() const { return last_; }

  // Calls visit(from, freer) for each change, in order, and clears the steps.
  template <typename Visit>
  void take_changes(Visit&& visit) {
    std::uint32_t* const end = &map_[(last_.crossed() - first_.crossed()) / 32 + 1];
    *end = kFirstBit;  // ends the search
    for (std::uint32_t* word = map_.data();; ++word) {
      while (*word == 0) {
        ++word;
      }
      std::uint32_t bits = std::exchange(*word, 0);
      if (word == end) {
        break;
      }
      const auto before = 32 * static_cast<std::uint32_t>(word - map_.data());
      while (bits != 0) {
        const auto zeros = static_cast<std::uint32_t>(std::countl_zero(bits));
        bits &= ~(kFirstBit >> zeros);
        const std::uint32_t number = before + zeros;
        const std::uint32_t slot = slots_[number];
        slots_[number] = 0;
        visit(Between::of(first_.crossed() + number, slot >> 16),
              static_cast<std::int32_t>(static_cast<std::int16_t>(slot)));
      }
    }
    beam_count_ = 0;
    from_start_ = 0;
    last_ = first_;
  }

 private:
  static constexpr std::uint32_t kFirstBit = std::uint32_t{1} << 31;

  Between first_;
  Between last_;
  std::uint32_t beam_count_ = 0;
  std::int32_t from_start_ = 0;
  std::array<std::uint32_t, kSlots / 32 + 1> map_{};  // the last word only ends a search
  std::array<std::uint32_t, kSlots> slots_{};
};

// The parts of a line in which beams are low. These parts begin far from the sensor and have gaps
// between them.
class LowSteps : public FreeSteps {};

// The pending beams of a line. `free` contains the amount by which the beams lower the line's
// cells. If heights are kept (grid/frame_grids.hpp), `low` contains the parts in which at least one
// beam is low. Each beam adds at most one entry to `free` and one to `low`.
struct LineSteps {
  // The amount by which a low beam lowers each cell in its low part. Cell values saturate, so
  // several overlapping low beams have the same effect as one.
  static constexpr std::int32_t kLow = index::kIndexMax<index::OccupancyIndex>;

  void begin_at(Between first) {
    free.begin_at(first);
    low.begin_at(first);
  }
  void add_low(const LinePart& part) {
    if (!part.is_empty()) {
      low.begin_beam(part.first, kLow);
      low.add(part.end, -kLow);
      low.end_beam(part.end);
    }
  }
  void drop() {
    free.take_changes([](Between /*point*/, std::int32_t /*freer*/) {});
    low.take_changes([](Between /*point*/, std::int32_t /*freer*/) {});
  }

  FreeSteps free;
  LowSteps low;
};

}  // namespace iog::grid
