// What the beams of one line say of its cells: how free, as a step function along it.
//
// Beams of one line carve prefixes of the same cells. Their evidence of one cell is negative, and
// such evidence commutes under saturation (contract section 3): adding a, then b, each with a floor
// at -127, is adding a + b with that floor. So their sum can be carved in one walk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "grid/block_path.hpp"
#include "sensor_model/profile.hpp"
#include "traversal/line.hpp"

namespace iog::grid {

// A point on a line between two of its cells: before the one at this position, or just after it.
struct Between {
  traversal::Position at;
  bool is_after = false;

  // The cells of the line that lie before it have fewer borders crossed than this.
  [[nodiscard]] constexpr std::uint32_t crossed() const {
    return at.crossed() + (is_after ? 1U : 0U);
  }
};

class FreeSteps {
 public:
  // From here on, cells are freer by so much; or less free, if below 0.
  struct Change {
    std::uint32_t crossed = 0;  // Between::crossed()
    std::int32_t freer = 0;
    Place place;                // of the cell at the position
    bool is_after = false;
  };

  // A beam's zones before its hit, where each begins, and the end of the last.
  static constexpr std::size_t kMaxChangesOfABeam = sensor_model::kMaxNearCells + 2;

  [[nodiscard]] bool has_room() const { return count_ + kMaxChangesOfABeam <= kMaxChanges; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  void clear() { count_ = 0; }

  // A beam's changes follow, none of them before `first`.
  void begin(traversal::Position first) {
    if (empty() || first.crossed() < first_.crossed()) {
      first_ = first;
    }
  }

  // Only if has_room() said so before the beam. Most beams begin together, and their further
  // changes mostly come in order.
  void add(const Change& change) {
    if (count_ > 0 && changes_[0].crossed == change.crossed) {
      changes_[0].freer += change.freer;
      return;
    }
    std::size_t place = count_;
    while (place > 0 && changes_[place - 1].crossed > change.crossed) {
      --place;
    }
    if (place > 0 && changes_[place - 1].crossed == change.crossed) {
      changes_[place - 1].freer += change.freer;
      return;
    }
    for (std::size_t i = count_; i > place; --i) {
      changes_[i] = changes_[i - 1];
    }
    changes_[place] = change;
    ++count_;
  }

  // Where the walk begins, and the changes in order; the last one's end leaves nothing to carve.
  [[nodiscard]] traversal::Position first() const { return first_; }
  [[nodiscard]] std::span<const Change> changes() const {
    return std::span(changes_).first(count_);
  }

 private:
  static constexpr std::size_t kMaxChanges = 32;

  std::array<Change, kMaxChanges> changes_{};
  std::size_t count_ = 0;
  traversal::Position first_;
};

}  // namespace iog::grid
