// What waits to be carved of one line among hundreds, of a lidar that turns: where and by how much
// cells become freer, one change after the other, which touches a few cache lines. FreeSteps puts
// them in order when the line is carved.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "grid/free_steps.hpp"
#include "grid/line_part.hpp"
#include "sensor_model/profile.hpp"

namespace iog::grid {

class WaitingSteps {
 public:
  // A beam has two changes at least, so that as many fit into FreeSteps.
  [[nodiscard]] bool has_room() const { return count_ <= kMaxChanges - kMostOfABeam; }

  // As in FreeSteps.
  void begin_beam(Between from, std::int32_t freer) { add(from, freer); }
  void add(Between from, std::int32_t freer) {
    changes_[count_] = {from, freer};
    ++count_;
  }
  void end_beam(Between end) { last_ = std::max(last_, end); }

  // Hands all of it to steps of which nothing waits, and waits for nothing.
  void move_to(FreeSteps& steps) {
    for (std::size_t i = 0; i < count_; ++i) {
      steps.add(changes_[i].from, changes_[i].freer);
    }
    steps.end_beam(last_);
    clear();
  }
  void clear() {
    count_ = 0;
    last_ = {};
  }

 private:
  static constexpr std::size_t kMostOfABeam = 2 + sensor_model::kMaxNearCells;
  static constexpr std::size_t kMaxChanges = 384;
  static_assert(kMaxChanges / 2 <= FreeSteps::kMaxBeams);

  struct Change {
    Between from;
    std::int32_t freer = 0;
  };

  std::size_t count_ = 0;
  Between last_;
  std::array<Change, kMaxChanges> changes_{};
};

}  // namespace iog::grid
