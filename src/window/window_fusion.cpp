#include "window/window_fusion.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "require/require.hpp"
#include "window/eight_bytes.hpp"
#include "window/ground.hpp"

namespace iog::window {
namespace {

// Groups from one that is fused to the one whose memory is asked for meanwhile.
constexpr std::size_t kGroupsAhead = 2;

evidence::Indexes indexes_of(const FrameEvidence::TileIndexes& tile, std::size_t group) {
  evidence::Indexes indexes;
  std::copy_n(&tile[group * evidence::kGroupCells], indexes.size(), indexes.begin());
  return indexes;
}

// Asks for the lines of a group that is needed soon.
void prefetch(const Tile& tile, std::size_t group) {
  constexpr std::size_t kLine = 32;
  const std::span bytes = std::as_bytes(std::span(&tile.groups[group], 1));
  for (std::size_t line = 0; line < sizeof(evidence::Group); line += kLine) {
    __builtin_prefetch(&bytes[line]);
  }
}

EightBytes eight_at(const FrameEvidence::TileIndexes& tile, std::size_t group) {
  return EightBytes::load(&tile[group * evidence::kGroupCells]);
}

}  // namespace

WindowFusion::WindowFusion(const Rules& rules)
    : rules_(rules), clock_(rules.discounting, rules.weighing) {}

// Evidence lies by slot, and would be of other tiles if the window moved under it.
void WindowFusion::follow(const pose::Pose& pose) {
  require(counts_.slices == 0);
  window_.follow(cell_of(pose));
}

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
  const TileUpdate update(clock_, rules_.assignment);
  std::uint32_t budget = budget_without_hits();
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    if (evidence_.is_touched(slot)) {
      fuse_tile(update, slot, budget);
    }
    if ((slot + frames_) % kRefreshFrames == 0 && window_.is_known(slot)) {
      refresh_tile(update, slot);
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
    for (std::size_t group = 0; evidence_.has_hit(slot) && group < kGroupsPerTile; ++group) {
      with_hits += eight_at(evidence_.tile(slot), group).has_positive() ? 1U : 0U;
    }
  }
  return rules_.group_budget - std::min(with_hits, rules_.group_budget);
}

void WindowFusion::fuse_tile(const TileUpdate& update, std::size_t slot, std::uint32_t& budget) {
  const FrameEvidence::TileIndexes& indexes = evidence_.tile(slot);
  Tile* tile = nullptr;
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    const EightBytes eight = eight_at(indexes, group);
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
    if (tile == nullptr) {
      tile = &open(slot);
    }
    prefetch(*tile, std::min(group + kGroupsAhead, kGroupsPerTile - 1));
    const bool all_moved = rules_.moved == Moved::kLiteral;
    update.fuse(*tile, group,
                {.indexes = indexes_of(indexes, group),
                 .moved = all_moved ? std::uint8_t{0xFF} : eight_of(arrivals_.moved(slot), group)});
    ++counts_.groups_fused;
  }
}

Tile& WindowFusion::open(std::size_t slot) {
  if (!window_.is_known(slot)) {
    refreshed_[slot] = clock_.now();
  }
  return window_.open(slot);
}

void WindowFusion::refresh_tile(const TileUpdate& update, std::size_t slot) {
  Tile& tile = window_.open(slot);
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    counts_.groups_refreshed += update.refresh(tile, group) ? 1U : 0U;
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
