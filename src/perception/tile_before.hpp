// The undo log of a tile. Before a core repeats the work of another core, it uses this log to
// restore the tile. For each group, the log stores the members on which the result depends. All
// other data written to a tile is derived from these members.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "window/tile.hpp"
#include "work/before_images.hpp"

namespace iog::perception {

class TileBefore {
 public:
  // Call begin() before changing any group of a tile.
  void begin(bool is_known) {
    is_known_ = is_known;
    count_ = 0;
  }

  // Call keep() once for each group, before changing it. Undefined masses are not stored. If a
  // group was never aged, all of its masses are undefined. If a group has only free mass, its
  // occupied masses are undefined.
  void keep(const window::Tile& tile, std::size_t group) {
    Group& kept = groups_[count_];
    kept.number = static_cast<std::uint8_t>(group);
    kept.aged_at = tile.aged_at[group];
    kept.evidence_at = tile.evidence_at[group];
    kept.is_free_alone = tile.is_free_alone[group];
    if (tile.is_known(group)) {
      kept.free = tile.free[group];
    }
    if (tile.is_known(group) && !tile.is_free_alone[group]) {
      kept.taken = tile.taken[group];
    }
    work::keep_order();
    ++count_;
    work::keep_order();
  }

  // Returns true if the tile was known. If the tile was unknown, nothing has to be restored.
  [[nodiscard]] bool is_known() const { return is_known_; }

  void put_back(window::Tile& tile) const {
    for (const Group& kept : std::span(groups_).first(count_)) {
      const std::size_t group = kept.number;
      tile.aged_at[group] = kept.aged_at;
      tile.evidence_at[group] = kept.evidence_at;
      tile.is_free_alone[group] = kept.is_free_alone;
      tile.free[group] = kept.free;
      tile.taken[group] = kept.is_free_alone ? evidence::Taken{} : kept.taken;
    }
  }

 private:
  struct Group {
    evidence::Taken taken{};
    evidence::Free free{};
    std::uint8_t number = 0;
    std::uint8_t aged_at = 0;
    std::uint8_t evidence_at = 0;
    bool is_free_alone = false;
  };

  bool is_known_ = false;
  std::size_t count_ = 0;
  std::array<Group, window::kGroupsPerTile> groups_{};
};

}  // namespace iog::perception
