#include "perception/window_fusion.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "perception/bring_tile.hpp"
#include "perception/ground.hpp"
#include "placing/evidence_bits.hpp"
#include "require/require.hpp"
#include "work/runs.hpp"

namespace iog::perception {
namespace {

// Where they lie: a copy of them would still be on its way to the cache when it is needed.
const evidence::Indexes& indexes_of(const placing::FrameEvidence::TileIndexes& tile,
                                    std::size_t group) {
  return *reinterpret_cast<const evidence::Indexes*>(&tile[group * evidence::kGroupCells]);
}

}  // namespace

WindowFusion::WindowFusion(const Rules& rules, bool is_followed)
    : rules_(rules),
      is_followed_(is_followed),
      clock_(rules.discounting, rules.weighing),
      arrivals_(rules),
      opening_(rules) {}

// Evidence lies by slot, and would be of other tiles if the window moved under it.
void WindowFusion::follow(const pose::Pose& pose) {
  require(counts_.slices == 0);
  window_.follow(window::cell_of(pose));
}

void WindowFusion::add(std::span<const placing::PlacedCells> slices, const work::Crew& crew) {
  require(slices.size() <= placing::FrameEvidence::kMostAtOnce);
  std::array<placing::PlacedCells, placing::FrameEvidence::kMostAtOnce> inside;
  std::size_t count = 0;
  for (const placing::PlacedCells& slice : slices) {
    if (window_.is_centred() && window_.area().contains(window::cell_of(slice.at.pose))) {
      inside[count++] = slice;
    } else {
      ++counts_.slices_outside;
    }
  }
  if (count > 0) {
    const auto added = std::span(inside).first(count);
    auto list_hits = [this, added] {
      if (is_followed_) {
        hits_.add(added, window_.area());
        names_.take_back(window_);
      }
    };
    evidence_.add(added, window_.area(), crew, work::beside_of(list_hits));
    counts_.slices += static_cast<std::uint32_t>(count);
  }
}

void WindowFusion::forget() {
  window_.forget();
  evidence_.clear();
  hits_.clear();
  counts_ = {};
  frames_ = 0;
  fused_frames_ = 0;
  last_turns_ = {};
}

void WindowFusion::decide_frame(std::uint64_t stamp_us, const work::Crew& crew,
                                work::Beside beside) {
  names_.take_back(window_);
  newest_us_ = std::max(newest_us_, stamp_us);
  clock_.advance(newest_us_);
  frames_ += window_.is_centred() ? 1U : 0U;
  find_arrivals(crew);
  update_tiles(crew, beside);
  add_up();
}

// Groups are counted only where evidence might not fit.
void WindowFusion::find_arrivals(const work::Crew& crew) {
  due_.count = 0;
  arrivals_.begin();
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    if (evidence_.is_touched(slot)) {
      due_.add(slot);
    }
  }
  const work::Runs runs(due_.count, kFound);
  crew.share(runs.count(), [&](std::size_t item, std::size_t /*core*/) {
    for (const std::uint16_t slot : due_.of(runs[item])) {
      look_at(slot);
    }
  });
  if (due_.count * window::kGroupsPerTile > rules_.group_budget) {
    count_groups(crew);
  }
}

// Most tiles of a frame hold free space alone, of which nothing is asked.
void WindowFusion::look_at(std::size_t slot) {
  slot_counts_[slot] = {};
  const bool is_known = window_.is_known(slot);
  const bool is_standing = is_known && has_standing_inside(window_.tile(slot));
  const bool is_hit = is_known && evidence_.has_hit(slot);
  if (!is_standing && !is_hit && !rules_.is_opened_from_below) {
    arrivals_.find_none(slot);
    return;
  }
  const placing::EvidenceBits bits = placing::bits_of(evidence_.tile(slot));
  arrivals_.find_new(window_, evidence_, slot, bits.hit);
  if (is_standing) {
    slot_counts_[slot].standing = standing_counts(
        window_.tile(slot), bits.hit, rules_.is_opened_from_below ? bits.from_below : bits.free);
  }
  if (rules_.is_opened_from_below) {
    opening_.find(window_, bits, slot);
  }
}

// What is taken gives way to low beams alone.
void WindowFusion::leave_out_high(std::size_t slot) {
  if (rules_.is_opened_from_below) {
    opening_.leave_out_high(evidence_, slot);
  }
}

// Who fuses all slots in their order need not count those without hits.
void WindowFusion::count_groups(const work::Crew& crew) {
  const bool are_shared = !crew.is_one();
  const work::Runs runs(due_.count, kFound);
  crew.share(runs.count(), [&](std::size_t item, std::size_t /*core*/) {
    for (const std::uint16_t slot : due_.of(runs[item])) {
      leave_out_high(slot);
      if (are_shared || evidence_.has_hit(slot)) {
        slot_counts_[slot].groups = groups_of(evidence_.tile(slot));
      }
    }
  });
}

WindowFusion::Budget WindowFusion::budget() const {
  std::size_t touched = 0;
  std::uint32_t with_hits = 0;
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    if (evidence_.is_touched(slot)) {
      ++touched;
      with_hits += slot_counts_[slot].groups.with_hits;
    }
  }
  if (touched * window::kGroupsPerTile <= rules_.group_budget) {
    return std::nullopt;
  }
  return GroupBudget{
      .with_hits = rules_.group_budget,
      .without_hits = rules_.group_budget - std::min(with_hits, rules_.group_budget)};
}

// One core spends the budget as it goes. Several are told by slot what is left of it.
void WindowFusion::update_tiles(const work::Crew& crew, work::Beside beside) {
  const TileUpdate update(clock_, rules_.assignment);
  Budget budget = this->budget();
  due_.count = 0;
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    if (evidence_.is_touched(slot)) {
      due_.add(slot);
    } else if (is_turn_to_refresh(slot) && window_.is_known(slot)) {
      slot_counts_[slot] = {};
      due_.add(slot);
    }
  }
  if (crew.is_one()) {
    for (const std::uint16_t slot : due_.all()) {
      update_tile(update, slot, budget);
    }
    beside();
    return;
  }
  deal_out(budget);
  tiles_before_.begin();
  const work::Runs runs(due_.count, kUpdated);
  crew.share(
      runs.count(),
      [&](std::size_t item, std::size_t core) {
        TilesBefore* const before = tiles_before_.of(core);
        if (before != nullptr) {
          before->begun = 0;
          tiles_before_.keep(core, item);
        } else if (const TilesBefore* const left = tiles_before_.of_lost(item)) {
          put_back(runs[item], *left);
        }
        for (const std::uint16_t slot : due_.of(runs[item])) {
          Budget of_slot = slot_counts_[slot].allowed;
          if (before != nullptr) {
            update_tile(update, slot, of_slot, before->begin(window_.is_known(slot)));
          } else {
            update_tile(update, slot, of_slot);
          }
        }
      },
      beside);
}

void WindowFusion::deal_out(Budget budget) {
  if (!budget) {
    return;
  }
  for (const std::uint16_t slot : due_.all()) {
    slot_counts_[slot].allowed = budget->take(slot_counts_[slot].groups);
  }
}

// The tiles that the run had come to, the last of them perhaps in part.
void WindowFusion::put_back(work::Run run, const TilesBefore& before) {
  for (std::size_t i = 0; i < before.begun; ++i) {
    put_back(due_.slots[run.first + i], before.tiles[i]);
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
    leave_out_high(slot);
    fuse_tile(update, slot, budget, before...);
  }
  if (is_turn_to_refresh(slot) && window_.is_known(slot)) {
    refresh_tile(update, slot, before...);
  }
  if (rules_.is_opened_from_below && window_.is_known(slot)) {
    opening_.remember(window_.open(slot), evidence_.is_touched(slot), slot);
  }
  note_names(slot);
}

template <typename... Before>
void WindowFusion::fuse_tile(const TileUpdate& update, std::size_t slot, Budget& budget,
                             Before&... before) {
  const placing::FrameEvidence::TileIndexes& indexes = evidence_.tile(slot);
  GroupList groups;
  std::size_t left = 0;
  for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
    const lanes::EightBytes eight = eight_at(indexes, group);
    if (eight.is_zero()) {
      continue;
    }
    if (budget && !budget->take(eight.has_positive())) {
      ++left;
      continue;
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
  const placing::FrameEvidence::TileIndexes& indexes = evidence_.tile(slot);
  window::Tile& tile = open(slot);
  for (std::size_t ahead = 0; ahead < kGroupsAhead; ++ahead) {
    groups.numbers[groups.count + ahead] = groups.numbers[groups.count - 1];
    prefetch(tile, groups.numbers[ahead]);
  }
  bring_rows(tile, groups.numbers[0] / window::kGroupsPerRow,
             groups.numbers[groups.count - 1] / window::kGroupsPerRow);
  const bool all_moved = rules_.moved == Moved::kLiteral;
  const bool has_hit = evidence_.has_hit(slot);
  const auto is_crossed = [&](std::size_t group) {
    return update.needs_no_taken(tile, group) &&
           !(has_hit && eight_at(indexes, group).has_positive());
  };
  for (std::size_t i = 0; i < groups.count; ++i) {
    const std::size_t group = groups.numbers[i];
    prefetch(tile, groups.numbers[i + kGroupsAhead]);
    (before.keep(tile, group), ...);
    if (!is_crossed(group)) {
      update.fuse(tile, group, indexes_of(indexes, group),
                  all_moved ? std::uint8_t{0xFF} : eight_of(arrivals_.moved(slot), group));
      continue;
    }
    const std::size_t next = groups.numbers[i + 1];
    if (i + 1 == groups.count || !is_crossed(next)) {
      update.cross(tile, group, indexes_of(indexes, group));
      continue;
    }
    (before.keep(tile, next), ...);
    update.cross(tile, {group, next}, {&indexes_of(indexes, group), &indexes_of(indexes, next)});
    ++i;
  }
}

window::Tile& WindowFusion::open(std::size_t slot) {
  if (!window_.is_known(slot)) {
    refreshed_[slot] = clock_.now();
  }
  return window_.open(slot);
}

template <typename... Before>
void WindowFusion::refresh_tile(const TileUpdate& update, std::size_t slot, Before&... before) {
  window::Tile& tile = window_.open(slot);
  std::size_t refreshed = 0;
  for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
    prefetch(tile, std::min(group + kGroupsAhead, window::kGroupsPerTile - 1));
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
    counts_.standing += slot_counts_[slot].standing;
    counts_.groups_fused += slot_counts_[slot].fused;
    counts_.groups_left += slot_counts_[slot].left;
    counts_.groups_refreshed += slot_counts_[slot].refreshed;
  }
}

// Which half of the slots has its turn to remember, and whether a period has begun since its turn
// before. The evidence of all of them is forgotten.
void WindowFusion::end_tiles(const work::Crew& crew, work::Beside beside) {
  const std::size_t parity = fused_frames_ % 2;
  const std::uint64_t period = newest_us_ / kPeriodUs;
  const bool is_new_period = last_turns_[parity].value_or(period) != period;
  last_turns_[parity] = period;
  ground_before_.begin();
  const work::Runs runs(window::kSlotCount, kEnded);
  crew.share(
      runs.count(),
      [&](std::size_t item, std::size_t core) {
        keep_ground(runs[item], item, core);
        end_slots(runs[item], is_new_period);
      },
      beside);
}

void WindowFusion::keep_ground(work::Run run, std::size_t item, std::size_t core) {
  if (GroundBefore* const before = ground_before_.of(core)) {
    for (std::size_t slot = run.first; slot < run.end; ++slot) {
      (*before)[slot - run.first] = window_.tile(slot).ground;
    }
    ground_before_.keep(core, item);
  } else if (const GroundBefore* const left = ground_before_.of_lost(item)) {
    for (std::size_t slot = run.first; slot < run.end; ++slot) {
      if (window_.is_known(slot)) {
        window_.ground(slot) = (*left)[slot - run.first];
      }
    }
  }
}

void WindowFusion::end_slots(work::Run run, bool is_new_period) {
  for (std::size_t slot = run.first; slot < run.end; ++slot) {
    evidence_.clear(slot);
    if (slot % 2 == fused_frames_ % 2 && window_.is_known(slot)) {
      remember(window_, slot, is_new_period);
    }
  }
}

}  // namespace iog::perception
