// Fuses, ages and classifies the groups of a tile in one frame.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "evidence/fusion.hpp"
#include "lanes/bring.hpp"
#include "lanes/eight_bytes.hpp"
#include "perception/tile_update.hpp"
#include "placing/frame_evidence.hpp"
#include "window/tile.hpp"

namespace iog::perception {

// Numbers of groups of two kinds: those with hits, and those with evidence but no hits.
struct GroupBudget {
  std::uint32_t with_hits = 0;
  std::uint32_t without_hits = 0;

  // Takes one group from the budget. Returns false if the budget is used up.
  bool take(bool has_hit) {
    std::uint32_t& left = has_hit ? with_hits : without_hits;
    if (left == 0) {
      return false;
    }
    --left;
    return true;
  }
  // Returns how many groups of each kind were taken.
  GroupBudget take(const GroupBudget& groups) {
    const GroupBudget taken{.with_hits = std::min(groups.with_hits, with_hits),
                            .without_hits = std::min(groups.without_hits, without_hits)};
    with_hits -= taken.with_hits;
    without_hits -= taken.without_hits;
    return taken;
  }
};

inline lanes::EightBytes eight_at(const placing::FrameEvidence::TileIndexes& tile,
                                  std::size_t group) {
  return lanes::EightBytes::load(&tile[group * evidence::kGroupCells]);
}

// Counts the groups that have evidence in a tile.
inline GroupBudget groups_of(const placing::FrameEvidence::TileIndexes& tile) {
  GroupBudget groups;
  for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
    const lanes::EightBytes eight = eight_at(tile, group);
    const bool has_hit = eight.has_positive();
    groups.with_hits += has_hit ? 1U : 0U;
    groups.without_hits += !has_hit && !eight.is_zero() ? 1U : 0U;
  }
  return groups;
}

// The remaining budget, or an empty optional if the number of groups is unlimited.
using Budget = std::optional<GroupBudget>;

// Prefetching runs kGroupsAhead groups ahead of fusion.
inline constexpr std::size_t kGroupsAhead = 4;

// Lists the groups of a tile that will be fused, in ascending order, and counts the groups that
// have evidence but exceed the budget. The last entry is repeated so that prefetching may read
// beyond the end.
class GroupList {
 public:
  GroupList(const placing::FrameEvidence::TileIndexes& indexes, Budget& budget) {
    for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
      const lanes::EightBytes eight = eight_at(indexes, group);
      if (eight.is_zero()) {
        continue;
      }
      if (budget && !budget->take(eight.has_positive())) {
        ++left_;
        continue;
      }
      numbers_[count_++] = static_cast<std::uint8_t>(group);
    }
    for (std::size_t ahead = 0; count_ > 0 && ahead < kGroupsAhead; ++ahead) {
      numbers_[count_ + ahead] = numbers_[count_ - 1];
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t left() const { return left_; }
  // `i` must be below count() + kGroupsAhead.
  [[nodiscard]] std::size_t operator[](std::size_t i) const { return numbers_[i]; }

 private:
  std::size_t count_ = 0;
  std::size_t left_ = 0;
  std::array<std::uint8_t, window::kGroupsPerTile + kGroupsAhead> numbers_;
};

// Prefetches the masses of a group that will soon be updated.
inline void prefetch(const window::Tile& tile, std::size_t group) {
  lanes::preload(&tile.free[group]);
  if (!tile.is_free_alone[group]) {
    lanes::preload(&tile.taken[group].occupied);
    lanes::preload(&tile.taken[group].standing);
  }
}

// Prefetches the small members of some rows of a tile, so that the cache lines of the masses can
// then be prefetched without interruption.
inline void bring_rows(const window::Tile& tile, std::size_t first, std::size_t last) {
  const std::size_t count = (last - first + 1) * window::kGroupsPerRow;
  lanes::bring(
      std::as_bytes(std::span(tile.decided).subspan(first * window::kGroupsPerRow, count)));
  if (tile.has_ruled_out) {
    lanes::bring(
        std::as_bytes(std::span(tile.ruled_out).subspan(first * window::kGroupsPerRow, count)));
  }
  lanes::bring(std::as_bytes(std::span(tile.aged_at)));
  lanes::bring(std::as_bytes(std::span(tile.evidence_at)));
  lanes::bring(std::as_bytes(std::span(tile.is_free_alone)));
  lanes::bring(std::as_bytes(std::span(&tile.found, 1)));
}

// Returns a reference, because reading a new copy would miss the cache.
inline const evidence::Indexes& indexes_of(const placing::FrameEvidence::TileIndexes& tile,
                                           std::size_t group) {
  return *reinterpret_cast<const evidence::Indexes*>(&tile[group * evidence::kGroupCells]);
}

// Fuses the groups in the list, which must not be empty. `moved` contains the cells whose hits are
// classified as moved. If `moved` is null, all hits are classified as moved. If a TileBefore is
// passed, it stores the state of the tile before the update, so that another core can restore the
// tile and repeat the work.
template <typename... Before>
void fuse_groups(const TileUpdate& update, window::Tile& tile,
                 const placing::FrameEvidence::TileIndexes& indexes, bool has_hit,
                 const window::Plane* moved, const GroupList& groups, Before&... before) {
  for (std::size_t ahead = 0; ahead < kGroupsAhead; ++ahead) {
    prefetch(tile, groups[ahead]);
  }
  bring_rows(tile, groups[0] / window::kGroupsPerRow,
             groups[groups.count() - 1] / window::kGroupsPerRow);
  const auto is_hit = [&](std::size_t group) {
    return has_hit && eight_at(indexes, group).has_positive();
  };
  // Calls TileUpdate::cross() once for kGroups consecutive groups, starting at entry i of the list.
  // Returns false if this is not possible.
  const auto cross = [&](auto at_once, std::size_t i) {
    constexpr std::size_t kGroups = at_once();
    const std::size_t group = groups[i];
    if (group % kGroups != 0 || groups[i + kGroups - 1] != group + kGroups - 1 ||
        i + kGroups > groups.count() || !update.template may_be_joint<kGroups>(tile, group)) {
      return false;
    }
    for (std::size_t each = group; each < group + kGroups; ++each) {
      if (is_hit(each)) {
        return false;
      }
    }
    for (std::size_t each = group; each < group + kGroups; ++each) {
      (before.keep(tile, each), ...);
    }
    update.template cross<kGroups>(tile, group, indexes_of(indexes, group));
    return true;
  };
  for (std::size_t i = 0; i < groups.count();) {
    const std::size_t group = groups[i];
    prefetch(tile, groups[i + kGroupsAhead]);
    if (cross(std::integral_constant<std::size_t, 4>(), i)) {
      prefetch(tile, groups[i + 4]);
      i += 4;
      continue;
    }
    if (cross(std::integral_constant<std::size_t, 2>(), i)) {
      i += 2;
      continue;
    }
    (before.keep(tile, group), ...);
    if (update.needs_no_taken(tile, group) && !is_hit(group)) {
      update.cross(tile, group, indexes_of(indexes, group));
    } else {
      update.fuse(tile, group, indexes_of(indexes, group),
                  moved == nullptr ? std::uint8_t{0xFF} : eight_of(*moved, group));
    }
    ++i;
  }
}

// Ages and classifies the groups that were not fused. Returns the number of groups that were aged
// and classified.
template <typename... Before>
std::size_t refresh_groups(const TileUpdate& update, window::Tile& tile, Before&... before) {
  std::size_t refreshed = 0;
  const auto keep = [&]([[maybe_unused]] std::size_t group) {
    (before.keep(tile, group), ...);
    ++refreshed;
  };
  for (std::size_t row = 0; row < window::kGroupsPerTile; row += window::kGroupsPerRow) {
    prefetch(tile, std::min(row + window::kGroupsPerRow, window::kGroupsPerTile - 1));
    if (update.is_old(tile, row) && update.may_be_joint<window::kGroupsPerRow>(tile, row)) {
      for (std::size_t group = row; group < row + window::kGroupsPerRow; ++group) {
        keep(group);
      }
      update.refresh_row(tile, row);
      continue;
    }
    for (std::size_t group = row; group < row + window::kGroupsPerRow; ++group) {
      if (update.is_old(tile, group)) {
        keep(group);
        update.refresh(tile, group);
      }
    }
  }
  return refreshed;
}

}  // namespace iog::perception
