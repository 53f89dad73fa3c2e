#include "window/window_fusion.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "require/require.hpp"
#include "window/bring.hpp"
#include "window/eight_bytes.hpp"
#include "window/ground.hpp"

namespace iog::window {
namespace {

// Where they lie: a copy of them would still be on its way to the cache when it is needed.
const evidence::Indexes& indexes_of(const FrameEvidence::TileIndexes& tile, std::size_t group) {
  return *reinterpret_cast<const evidence::Indexes*>(&tile[group * evidence::kGroupCells]);
}

// Asks for the lines of a group that is needed soon.
void prefetch(const Tile& tile, std::size_t group) {
  __builtin_prefetch(&tile.free[group]);
  if (!tile.is_free_alone[group]) {
    __builtin_prefetch(&tile.taken[group].occupied);
    __builtin_prefetch(&tile.taken[group].standing);
  }
}

// Brings the small things of some rows of a tile to the cache. Then the lines of its masses follow
// one another, and nothing comes between them.
void bring_rows(const Tile& tile, std::size_t first, std::size_t last) {
  const std::size_t count = (last - first + 1) * kGroupsPerRow;
  bring(std::as_bytes(std::span(tile.decided).subspan(first * kGroupsPerRow, count)));
  bring(std::as_bytes(std::span(tile.ruled_out).subspan(first * kGroupsPerRow, count)));
  bring(std::as_bytes(std::span(tile.aged_at)));
  bring(std::as_bytes(std::span(tile.evidence_at)));
  bring(std::as_bytes(std::span(tile.is_free_alone)));
  bring(std::as_bytes(std::span(&tile.found, 1)));
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

void WindowFusion::add(const Placement& at, const work::Crew& crew) {
  if (window_.is_centred() && window_.area().contains(cell_of(at.pose))) {
    evidence_.add(cells_, window_.area(), at, crew);
    ++counts_.slices;
  } else {
    ++counts_.slices_outside;
  }
  cells_.clear(crew);
}

void WindowFusion::forget() {
  window_.forget();
  evidence_.clear();
  counts_ = {};
  frames_ = 0;
}

FrameCounts WindowFusion::finish(std::uint64_t stamp_us, const work::Crew& crew) {
  if (!is_frame(stamp_us)) {
    return std::exchange(counts_, {});
  }
  newest_us_ = std::max(newest_us_, stamp_us);
  clock_.advance(newest_us_);
  frames_ += window_.is_centred() ? 1U : 0U;
  find_arrivals(crew);
  update_tiles(crew);
  add_up();
  if (counts_.slices > 0) {
    ++fused_frames_;
    end_tiles(crew);
  }
  return std::exchange(counts_, {});
}

// Groups are counted only where evidence might not fit.
void WindowFusion::find_arrivals(const work::Crew& crew) {
  constexpr std::size_t kInEach = 8;
  due_.count = 0;
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    slot_counts_[slot] = {};
    if (evidence_.is_touched(slot)) {
      due_.add(slot);
    }
  }
  const bool is_tight = due_.count * kGroupsPerTile > rules_.group_budget;
  const bool are_shared = !crew.is_one();
  crew.share(work::items_of(due_.count, kInEach), [&](std::size_t item, std::size_t /*core*/) {
    const std::size_t end = std::min(due_.count, (item + 1) * kInEach);
    for (std::size_t i = item * kInEach; i < end; ++i) {
      const std::size_t slot = due_.slots[i];
      arrivals_.find_new(window_, evidence_, slot);
      if (is_tight) {
        count_groups(slot, are_shared);
      }
    }
  });
}

// Who fuses all slots in their order need not count those without hits.
void WindowFusion::count_groups(std::size_t slot, bool are_shared) {
  std::size_t with_hits = 0;
  std::size_t without_hits = 0;
  if (!are_shared && !evidence_.has_hit(slot)) {
    return;
  }
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    const EightBytes eight = eight_at(evidence_.tile(slot), group);
    const bool has_hit = eight.has_positive();
    with_hits += has_hit ? 1U : 0U;
    without_hits += !has_hit && !eight.is_zero() ? 1U : 0U;
  }
  slot_counts_[slot].with_hits = static_cast<std::uint8_t>(with_hits);
  slot_counts_[slot].without_hits = static_cast<std::uint8_t>(without_hits);
}

WindowFusion::Budget WindowFusion::budget_without_hits() const {
  std::size_t touched = 0;
  std::uint32_t with_hits = 0;
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    touched += evidence_.is_touched(slot) ? 1U : 0U;
    with_hits += slot_counts_[slot].with_hits;
  }
  if (touched * kGroupsPerTile <= rules_.group_budget) {
    return std::nullopt;
  }
  return rules_.group_budget - std::min(with_hits, rules_.group_budget);
}

// One core spends the budget as it goes. Several are told by slot what is left of it.
void WindowFusion::update_tiles(const work::Crew& crew) {
  const TileUpdate update(clock_, rules_.assignment);
  Budget budget = budget_without_hits();
  due_.count = 0;
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    if (evidence_.is_touched(slot) || (is_turn_to_refresh(slot) && window_.is_known(slot))) {
      due_.add(slot);
    }
  }
  if (crew.is_one()) {
    for (const std::uint16_t slot : due_.all()) {
      update_tile(update, slot, budget);
    }
    return;
  }
  deal_out(budget);
  tiles_before_.begin();
  crew.share(due_.count, [&](std::size_t item, std::size_t core) {
    const std::size_t slot = due_.slots[item];
    Budget of_slot = budget ? Budget(slot_counts_[slot].allowed) : std::nullopt;
    if (TileBefore* const before = tiles_before_.of(core)) {
      before->begin(window_.is_known(slot));
      tiles_before_.keep(core, item);
      update_tile(update, slot, of_slot, *before);
      return;
    }
    if (const TileBefore* const left = tiles_before_.of_lost(item)) {
      put_back(slot, *left);
    }
    update_tile(update, slot, of_slot);
  });
}

void WindowFusion::deal_out(Budget budget) {
  for (const std::uint16_t slot : due_.all()) {
    if (budget) {
      SlotCounts& counts = slot_counts_[slot];
      counts.allowed =
          static_cast<std::uint8_t>(std::min<std::uint32_t>(counts.without_hits, *budget));
      *budget -= counts.allowed;
    }
  }
}

void WindowFusion::put_back(std::size_t slot, const TileBefore& before) {
  if (before.is_known()) {
    before.put_back(window_.open(slot));
  } else {
    window_.close(slot);
  }
}

template <typename... Before>
void WindowFusion::update_tile(const TileUpdate& update, std::size_t slot, Budget& budget,
                               Before&... before) {
  if (evidence_.is_touched(slot)) {
    arrivals_.find_moved(window_, slot);
    fuse_tile(update, slot, budget, before...);
  }
  if (is_turn_to_refresh(slot) && window_.is_known(slot)) {
    refresh_tile(update, slot, before...);
  }
}

template <typename... Before>
void WindowFusion::fuse_tile(const TileUpdate& update, std::size_t slot, Budget& budget,
                             Before&... before) {
  const FrameEvidence::TileIndexes& indexes = evidence_.tile(slot);
  GroupList groups;
  std::size_t left = 0;
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    const EightBytes eight = eight_at(indexes, group);
    if (eight.is_zero()) {
      continue;
    }
    if (budget && !eight.has_positive()) {
      if (*budget == 0) {
        ++left;
        continue;
      }
      --*budget;
    }
    groups.add(group);
  }
  slot_counts_[slot].left = static_cast<std::uint8_t>(left);
  slot_counts_[slot].fused = static_cast<std::uint8_t>(groups.count);
  if (groups.count > 0) {
    fuse_groups(update, slot, groups, before...);
  }
}

template <typename... Before>
void WindowFusion::fuse_groups(const TileUpdate& update, std::size_t slot, GroupList& groups,
                               Before&... before) {
  const FrameEvidence::TileIndexes& indexes = evidence_.tile(slot);
  Tile& tile = open(slot);
  for (std::size_t ahead = 0; ahead < kGroupsAhead; ++ahead) {
    groups.numbers[groups.count + ahead] = groups.numbers[groups.count - 1];
    prefetch(tile, groups.numbers[ahead]);
  }
  bring_rows(tile, groups.numbers[0] / kGroupsPerRow,
             groups.numbers[groups.count - 1] / kGroupsPerRow);
  const bool all_moved = rules_.moved == Moved::kLiteral;
  for (std::size_t i = 0; i < groups.count; ++i) {
    const std::size_t group = groups.numbers[i];
    prefetch(tile, groups.numbers[i + kGroupsAhead]);
    (before.keep(tile, group), ...);
    if (update.needs_no_taken(tile, group) && !eight_at(indexes, group).has_positive()) {
      update.cross(tile, group, indexes_of(indexes, group));
      continue;
    }
    update.fuse(tile, group, indexes_of(indexes, group),
                all_moved ? std::uint8_t{0xFF} : eight_of(arrivals_.moved(slot), group));
  }
}

Tile& WindowFusion::open(std::size_t slot) {
  if (!window_.is_known(slot)) {
    refreshed_[slot] = clock_.now();
  }
  return window_.open(slot);
}

template <typename... Before>
void WindowFusion::refresh_tile(const TileUpdate& update, std::size_t slot, Before&... before) {
  Tile& tile = window_.open(slot);
  std::size_t refreshed = 0;
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    prefetch(tile, std::min(group + kGroupsAhead, kGroupsPerTile - 1));
    if (update.is_old(tile, group)) {
      (before.keep(tile, group), ...);
      update.refresh(tile, group);
      ++refreshed;
    }
  }
  slot_counts_[slot].refreshed = static_cast<std::uint8_t>(refreshed);
  refreshed_[slot] = clock_.now();
}

void WindowFusion::add_up() {
  for (const std::uint16_t slot : due_.all()) {
    counts_.groups_fused += slot_counts_[slot].fused;
    counts_.groups_left += slot_counts_[slot].left;
    counts_.groups_refreshed += slot_counts_[slot].refreshed;
  }
}

// Which half of the slots has its turn to remember, and whether a period has begun since its turn
// before. The evidence of all of them is forgotten.
void WindowFusion::end_tiles(const work::Crew& crew) {
  const std::size_t parity = fused_frames_ % 2;
  const std::uint64_t period = newest_us_ / kPeriodUs;
  const bool is_new_period = last_turns_[parity].value_or(period) != period;
  last_turns_[parity] = period;
  ground_before_.begin();
  crew.share(work::items_of(kSlotCount, kSlotsInEach),
             [&](std::size_t item, std::size_t core) { end_slots(item, core, is_new_period); });
}

void WindowFusion::end_slots(std::size_t item, std::size_t core, bool is_new_period) {
  const std::size_t first = item * kSlotsInEach;
  if (GroundBefore* const before = ground_before_.of(core)) {
    for (std::size_t i = 0; i < kSlotsInEach; ++i) {
      (*before)[i] = window_.tile(first + i).ground;
    }
    ground_before_.keep(core, item);
  } else if (const GroundBefore* const left = ground_before_.of_lost(item)) {
    for (std::size_t i = 0; i < kSlotsInEach; ++i) {
      if (window_.is_known(first + i)) {
        window_.open(first + i).ground = (*left)[i];
      }
    }
  }
  for (std::size_t slot = first; slot < first + kSlotsInEach; ++slot) {
    evidence_.clear(slot);
    if (slot % 2 == fused_frames_ % 2 && window_.is_known(slot)) {
      remember(window_, slot, is_new_period);
    }
  }
}

}  // namespace iog::window
