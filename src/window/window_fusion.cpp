#include "window/window_fusion.hpp"

#include <algorithm>
#include <utility>

#include "window/eight_bytes.hpp"
#include "window/ground.hpp"
#include "window/tile_update.hpp"

namespace iog::window {
namespace {

evidence::Indexes indexes_of(const FrameEvidence::TileIndexes& tile, std::size_t group) {
  evidence::Indexes indexes;
  std::copy_n(&tile[group * evidence::kGroupCells], indexes.size(), indexes.begin());
  return indexes;
}

std::uint8_t eight_of(const Plane& plane, std::size_t group) {
  const std::uint32_t row = plane[group / kGroupsPerRow];
  return static_cast<std::uint8_t>(row >> (group % kGroupsPerRow * evidence::kGroupCells));
}

EightBytes eight_at(const FrameEvidence::TileIndexes& tile, std::size_t group) {
  return EightBytes::load(&tile[group * evidence::kGroupCells]);
}

}  // namespace

WindowFusion::WindowFusion(const Rules& rules)
    : rules_(rules), clock_(rules.discounting, rules.weighing) {}

void WindowFusion::follow(const pose::Pose& pose) { window_.follow(cell_of(pose)); }

void WindowFusion::forget() {
  window_.forget();
  evidence_.clear();
  counts_ = {};
}

FrameCounts WindowFusion::finish(std::uint64_t stamp_us) {
  newest_us_ = std::max(newest_us_, stamp_us);
  clock_.advance(newest_us_);
  ++frames_;
  arrivals_.find(window_, evidence_);
  std::uint32_t budget = budget_without_hits();
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    if (evidence_.is_touched(slot)) {
      fuse_tile(slot, budget);
    }
    if ((slot + frames_) % kRefreshFrames == 0 && window_.is_known(slot)) {
      refresh_tile(slot);
    }
  }
  if (counts_.slices > 0) {
    ++fused_frames_;
    remember_tiles();
  }
  evidence_.clear();
  return std::exchange(counts_, {});
}

// Hits need to be counted only where evidence might not fit.
std::uint32_t WindowFusion::budget_without_hits() const {
  std::uint32_t groups = 0;
  std::uint32_t with_hits = 0;
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    groups += evidence_.is_touched(slot) ? std::uint32_t{kGroupsPerTile} : 0;
  }
  if (groups <= rules_.group_budget) {
    return groups;
  }
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    for (std::size_t group = 0; evidence_.is_touched(slot) && group < kGroupsPerTile; ++group) {
      with_hits += eight_at(evidence_.tile(slot), group).has_positive() ? 1U : 0U;
    }
  }
  return rules_.group_budget - std::min(with_hits, rules_.group_budget);
}

void WindowFusion::fuse_tile(std::size_t slot, std::uint32_t& budget) {
  const FrameEvidence::TileIndexes& tile_indexes = evidence_.tile(slot);
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    const EightBytes eight = eight_at(tile_indexes, group);
    if (eight.is_zero()) {
      continue;
    }
    if (!eight.has_positive()) {
      if (budget == 0) {
        ++counts_.groups_left;
        continue;
      }
      --budget;
    }
    if (!window_.is_known(slot)) {
      refreshed_[slot] = clock_.now();
    }
    const bool all_moved = rules_.moved == Moved::kLiteral;
    const GroupEvidence what{
        .indexes = indexes_of(tile_indexes, group),
        .moved = all_moved ? std::uint8_t{0xFF} : eight_of(arrivals_.moved(slot), group)};
    fuse_group(window_.open(slot), group, what, clock_, rules_.assignment);
    ++counts_.groups_fused;
  }
}

void WindowFusion::refresh_tile(std::size_t slot) {
  Tile& tile = window_.open(slot);
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    if (tile.aged_at[group] != clock_.now() && refresh_group(tile, group, clock_)) {
      ++counts_.groups_refreshed;
    }
  }
  refreshed_[slot] = clock_.now();
}

void WindowFusion::remember_tiles() {
  const std::size_t parity = fused_frames_ % 2;
  const std::uint64_t period = newest_us_ / kPeriodUs;
  const bool is_new_period = last_turns_[parity].value_or(period) != period;
  last_turns_[parity] = period;
  for (std::size_t slot = parity; slot < kSlotCount; slot += 2) {
    if (window_.is_known(slot)) {
      remember(window_, slot, is_new_period);
    }
  }
}

}  // namespace iog::window
