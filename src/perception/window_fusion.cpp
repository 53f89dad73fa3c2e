#include "perception/window_fusion.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "placing/evidence_bits.hpp"
#include "require/require.hpp"
#include "work/runs.hpp"

namespace iog::perception {
WindowFusion::WindowFusion(const Rules& rules, bool is_followed, std::int32_t cell_mm)
    : ground_(rules.around),
      window_(rules.extent),
      rules_(rules),
      is_followed_(is_followed),
      cell_mm_(cell_mm),
      clock_(rules.discounting, rules.weighing, rules.tables),
      arrivals_(rules),
      opening_(rules) {}

// Evidence is stored by slot. If the window moved, it would belong to other tiles.
void WindowFusion::follow(const pose::Pose& pose) {
  require(counts_.slices == 0);
  window_.follow(window::cell_of(pose, cell_mm_));
}

void WindowFusion::add(std::span<const placing::PlacedCells> slices, const work::Crew& crew) {
  require(slices.size() <= placing::FrameEvidence::kMostAtOnce);
  std::array<placing::PlacedCells, placing::FrameEvidence::kMostAtOnce> inside;
  std::size_t count = 0;
  for (const placing::PlacedCells& slice : slices) {
    if (window_.is_centred() && window_.area().contains(window::cell_of(slice.at.pose, cell_mm_))) {
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
  ground_.forget();
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

// Groups are counted only if the evidence might exceed the budget.
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

// Most tiles of a frame have only free space, for which nothing is computed.
void WindowFusion::look_at(std::size_t slot) {
  slot_counts_[slot] = {};
  const bool is_known = window_.is_known(slot);
  const bool is_standing =
      window_.may_have(slot, &window::Found::stands) && has_standing_inside(window_.tile(slot));
  const bool is_hit = is_known && evidence_.has_hit(slot);
  if (!is_standing && !is_hit && !rules_.is_opened_from_below) {
    arrivals_.find_none(slot);
    return;
  }
  const placing::EvidenceBits bits = placing::bits_of(evidence_.tile(slot));
  arrivals_.find_new(window_, evidence_, slot, bits.hit);
  if (is_standing) {
    slot_counts_[slot].standing =
        standing_counts(window_.tile(slot), bits.hit,
                        rules_.is_opened_from_below ? bits.from_below : bits.free, rules_.around);
  }
  if (rules_.is_opened_from_below) {
    opening_.find(window_, bits, slot);
  }
}

// Only low beams may free occupied cells.
void WindowFusion::leave_out_high(std::size_t slot) {
  if (rules_.is_opened_from_below) {
    opening_.leave_out_high(evidence_, slot);
  }
}

// Slots without hits need no count when one core fuses all slots in order.
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

Budget WindowFusion::budget() const {
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

// One core spends the budget in order. For several cores, each slot gets its share in advance.
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

// Restores the tiles that the run had reached. The last one may be incomplete.
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
    slot_counts_[slot].refreshed =
        static_cast<std::uint8_t>(refresh_groups(update, window_.open(slot), before...));
    refreshed_[slot] = clock_.now();
  }
  if (rules_.is_opened_from_below && window_.is_known(slot)) {
    opening_.remember(window_.open(slot), evidence_.is_touched(slot), slot);
  }
  if (window_.is_known(slot)) {
    window_.note_found(slot);
  }
  note_names(slot);
}

template <typename... Before>
void WindowFusion::fuse_tile(const TileUpdate& update, std::size_t slot, Budget& budget,
                             Before&... before) {
  const placing::FrameEvidence::TileIndexes& indexes = evidence_.tile(slot);
  const GroupList groups(indexes, budget);
  slot_counts_[slot].left = static_cast<std::uint8_t>(groups.left());
  slot_counts_[slot].fused = static_cast<std::uint8_t>(groups.count());
  if (groups.count() > 0) {
    const bool all_moved = rules_.moved == Moved::kLiteral;
    fuse_groups(update, open(slot), indexes, evidence_.has_hit(slot),
                all_moved ? nullptr : &arrivals_.moved(slot), groups, before...);
  }
}

window::Tile& WindowFusion::open(std::size_t slot) {
  if (!window_.is_known(slot)) {
    refreshed_[slot] = clock_.now();
  }
  return window_.open(slot);
}

void WindowFusion::add_up() {
  for (const std::uint16_t slot : due_.all()) {
    counts_.standing += slot_counts_[slot].standing;
    counts_.groups_fused += slot_counts_[slot].fused;
    counts_.groups_left += slot_counts_[slot].left;
    counts_.groups_refreshed += slot_counts_[slot].refreshed;
  }
}

}  // namespace iog::perception
