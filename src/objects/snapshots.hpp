// Stores recent boxes of a track, each with some of the cells that were hit at the time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/cell.hpp"
#include "objects/plane.hpp"
#include "objects/rules.hpp"

namespace iog::objects {

struct Snapshot {
  std::uint64_t time_us = 0;
  Box box{};
  std::array<geometry::Cell, kSnapshotHits> cells{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const geometry::Cell> all() const {
    return std::span(cells).first(count);
  }
};

// The last kSnapshots snapshots. Successive snapshots are at least kSnapshotUs apart.
class Snapshots {
 public:
  [[nodiscard]] bool is_due(std::uint64_t now_us) const { return now_us >= last_us_ + kSnapshotUs; }

  // Begins a new snapshot, which replaces the oldest one. The caller fills in the cells of the new
  // snapshot.
  [[nodiscard]] Snapshot& begin(std::uint64_t now_us, const Box& box) {
    last_us_ = now_us;
    Snapshot& next = all_[next_];
    next_ = (next_ + 1) % kSnapshots;
    next.time_us = now_us;
    next.box = box;
    next.count = 0;
    return next;
  }

  // Returns the youngest non-empty snapshot taken at or before `time_us`, or null if there is none.
  [[nodiscard]] const Snapshot* youngest_before(std::uint64_t time_us) const {
    const Snapshot* youngest = nullptr;
    for (const Snapshot& its : all_) {
      if (its.count > 0 && its.time_us <= time_us &&
          (youngest == nullptr || its.time_us > youngest->time_us)) {
        youngest = &its;
      }
    }
    return youngest;
  }

 private:
  std::array<Snapshot, kSnapshots> all_{};
  std::size_t next_ = 0;
  std::uint64_t last_us_ = 0;
};

}  // namespace iog::objects
