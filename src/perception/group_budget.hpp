// How many groups of a frame may be fused, and who has how many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "lanes/eight_bytes.hpp"
#include "placing/frame_evidence.hpp"

namespace iog::perception {

// Groups with a hit, and groups with evidence but without one.
struct GroupBudget {
  std::uint32_t with_hits = 0;
  std::uint32_t without_hits = 0;

  // Whether there is room for one more.
  bool take(bool has_hit) {
    std::uint32_t& left = has_hit ? with_hits : without_hits;
    if (left == 0) {
      return false;
    }
    --left;
    return true;
  }
  // What there is room for, of these.
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

// Of a tile of a frame's evidence.
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

}  // namespace iog::perception
