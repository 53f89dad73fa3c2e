// What the beams of one line say of its cells: how free, as a step function along it.
//
// Beams of one line carve prefixes of the same cells. Their evidence of one cell is negative, and
// such evidence commutes under saturation (docs/model.md section 3): adding a, then b, each with a
// floor at -127, is adding a + b with that floor. So their sum can be carved in one walk.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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
    traversal::Position at;     // Between::at; after it if more borders are crossed than there
    std::int32_t freer = 0;
  };

  // A beam's zones before its hit, where each begins, and the end of the last.
  static constexpr std::size_t kMaxChangesOfABeam = sensor_model::kMaxNearCells + 2;

  [[nodiscard]] bool has_room() const { return count_ + kMaxChangesOfABeam <= kMaxChanges; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  void clear() {
    count_ = 0;
    from_start_ = 0;
  }

  // The line is freer from its start on. A change less free follows.
  void add_from_start(std::int32_t freer) { from_start_ += freer; }

  // Only if has_room() said so before the beam. A beam's further changes mostly come in order.
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

  // How much freer the line is from its start on, and the changes after that, in order; the last
  // one's end leaves nothing to carve.
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
