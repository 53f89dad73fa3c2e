// The window in time, cell by cell and frame by frame, with stamps instead of slots of a ring,
// tiles in a map and no rows of bits: slow, for comparison with window::WindowFusion.
//
// Poses are whole cells without rotation; frame_evidence_test.cpp has the others. What happens to a
// group by itself is that of src/evidence and src/decision, which have tests of their own.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "ageing/discounting.hpp"
#include "ageing/gains.hpp"
#include "decision/decision.hpp"
#include "evidence/fusion.hpp"
#include "fakes/group.hpp"
#include "perception/flat_ground.hpp"
#include "placing/slice.hpp"
#include "window/area.hpp"

namespace iog::tests {

struct PlacedSlice {
  Slice slice;
  Cell vehicle;  // the cell whose lowest corner is the vehicle's origin
};

struct PlainGroup {
  evidence::Group masses{};
  decision::RuledOut ruled_out{};
  decision::Decided decided{};
  std::optional<std::uint64_t> aged_ms;
  std::optional<std::uint64_t> evidence_ms;
};

struct PlainTile {
  std::array<PlainGroup, 128> groups{};
  std::array<GroundCell, geometry::kTileCells> ground{};
  std::uint32_t refreshed_frame = 0;
};

class PlainFusion {
 public:
  // Whether ground is opened only from below, and how far away a tall hit is at most then, in cells
  // along either axis. What is taken gives way to low beams alone then if sensors look over things.
  explicit PlainFusion(bool is_opened_from_below = false, std::int32_t tall_within = 3,
                       bool looks_over_things = true, const Looks& looks = {},
                       window::Extent extent = {})
      : is_from_below_(is_opened_from_below),
        tall_within_(tall_within),
        looks_over_things_(looks_over_things),
        looks_(looks),
        extent_(extent) {}

  using Tiles = std::map<std::pair<std::int32_t, std::int32_t>, PlainTile>;  // by b, a

  void follow(Cell vehicle) {
    area_ = is_placed_ ? area_.following(vehicle) : window::Area::around(vehicle, extent_);
    is_placed_ = true;
    std::erase_if(tiles_, [this](const auto& tile) {
      return !area_.contains(window::TileNumber{tile.first.second, tile.first.first});
    });
  }

  void frame(const std::vector<PlacedSlice>& slices, std::uint64_t stamp_us) {
    now_us_ = std::max(now_us_, stamp_us);
    ++frames_;
    Evidence evidence = joined(slices);
    const Moved moved = moved_of(evidence);
    const Opened opened = is_from_below_ ? opened_by(evidence) : Opened{};
    fuse(evidence, moved);
    refresh();
    if (is_from_below_) {
      open(opened);
    }
    if (!slices.empty()) {
      ++fused_;
      remember();
    }
  }

  [[nodiscard]] const Tiles& tiles() const { return tiles_; }
  [[nodiscard]] std::uint32_t frames() const { return frames_; }

 private:
  [[nodiscard]] std::uint64_t now_ms() const { return now_us_ / 1000; }

  struct Said {
    int index = 0;
    bool is_low = false;
    bool is_tall = false;
  };
  using Evidence = std::map<std::pair<std::int32_t, std::int32_t>, Said>;  // by y, x
  using Opened = std::map<std::pair<std::int32_t, std::int32_t>, bool>;
  using Moved = std::map<std::pair<std::int32_t, std::int32_t>, bool>;
  static constexpr std::int32_t kSide = geometry::kTileSide;

  [[nodiscard]] Evidence joined(const std::vector<PlacedSlice>& slices) const {
    Evidence hits;
    Evidence free;
    for (const PlacedSlice& placed : slices) {
      const Cell vehicle = placed.vehicle;
      placed.slice.for_each([&](Cell cell, int index) {
        const Cell at{cell.x - geometry::kOriginCell + vehicle.x,
                      cell.y - geometry::kOriginCell + vehicle.y};
        if (area_.contains(at)) {
          Said& said = (index > 0 ? hits : free)[{at.y, at.x}];
          const std::int8_t byte = placed.slice.byte_at(cell);
          said.index += index;
          said.is_low |= placing::is_from_below(byte);
          said.is_tall |= placing::is_tall(byte);
        }
      });
    }
    for (const auto& [cell, said] : hits) {
      free.insert_or_assign(cell, said);
    }
    for (auto& [cell, said] : free) {
      said.index = std::clamp(said.index, -31, 31);
    }
    return free;
  }

  // A flat copy of the ground of all known tiles.
  struct Copy {
    Cell low;
    FlatGround flat;
  };
  [[nodiscard]] Copy flat_copy() const {
    Cell low{0, 0};
    Cell high{0, 0};
    bool is_first = true;
    for (const auto& [number, tile] : tiles_) {
      const Cell first{number.second * kSide, number.first * kSide};
      low = is_first ? first : Cell{std::min(low.x, first.x), std::min(low.y, first.y)};
      high = is_first ? first : Cell{std::max(high.x, first.x), std::max(high.y, first.y)};
      is_first = false;
    }
    Copy copy{low, FlatGround(high.x - low.x + kSide, high.y - low.y + kSide, looks_)};
    for (const auto& [number, tile] : tiles_) {
      for (std::int32_t i = 0; i < kSide * kSide; ++i) {
        copy.flat.at(
            {number.second * kSide - low.x + i % kSide, number.first * kSide - low.y + i / kSide}) =
            tile.ground[static_cast<std::size_t>(i)];
      }
    }
    return copy;
  }

  [[nodiscard]] Moved moved_of(const Evidence& evidence) const {
    Moved moved;
    if (tiles_.empty()) {
      return moved;
    }
    Copy copy = flat_copy();
    const auto in_copy = [&](const auto& cell) {
      return Cell{cell.second - copy.low.x, cell.first - copy.low.y};
    };
    for (const auto& [cell, said] : evidence) {
      if (said.index > 0 && copy.flat.area().contains(in_copy(cell))) {
        GroundCell& is = copy.flat.at(in_copy(cell));
        is.is_hit = !is_from_below_ || (is.is_from_below && is_tall_around(evidence, cell));
      }
    }
    for (const auto& [cell, said] : evidence) {
      moved[cell] = copy.flat.has_moved(in_copy(cell));
    }
    return moved;
  }

  [[nodiscard]] bool is_tall_around(const Evidence& evidence,
                                    const std::pair<std::int32_t, std::int32_t>& cell) const {
    for (std::int32_t y = -tall_within_; y <= tall_within_; ++y) {
      for (std::int32_t x = -tall_within_; x <= tall_within_; ++x) {
        const auto near = evidence.find({cell.first + y, cell.second + x});
        if (near != evidence.end() && near->second.is_tall) {
          return true;
        }
      }
    }
    return false;
  }

  // From the state before the frame: which cells are from below after it. What is taken and free by
  // beams that are not low is left out.
  Opened opened_by(Evidence& evidence) {
    Opened opened;
    std::erase_if(evidence, [&](const auto& one) {
      const auto& [cell, said] = one;
      const std::pair number{numeric::div_floor(cell.first, kSide),
                             numeric::div_floor(cell.second, kSide)};
      const auto tile = tiles_.find(number);
      const auto in_tile = static_cast<std::size_t>((cell.first - number.first * kSide) * kSide +
                                                    cell.second - number.second * kSide);
      const GroundCell is = tile == tiles_.end() ? GroundCell{} : tile->second.ground[in_tile];
      if (said.index < 0 && said.is_low) {
        opened[cell] = true;
      } else if (said.index > 0 && is.stands) {
        opened[cell] = false;
      }
      return looks_over_things_ && said.index < 0 && !said.is_low && is.taken;
    });
    return opened;
  }

  void open(const Opened& opened) {
    for (auto& [number, tile] : tiles_) {
      for (std::int32_t i = 0; i < kSide * kSide; ++i) {
        GroundCell& is = tile.ground[static_cast<std::size_t>(i)];
        const auto change =
            opened.find({number.first * kSide + i / kSide, number.second * kSide + i % kSide});
        is.is_from_below = change == opened.end() ? is.is_from_below : change->second;
        is.freed = is.freed && is.is_from_below;
        is.seen = is.seen && is.is_from_below;
      }
    }
  }

  void age(PlainGroup& group) const {
    if (group.aged_ms && *group.aged_ms != now_ms()) {
      const auto ms = static_cast<std::uint32_t>(now_ms() - *group.aged_ms);
      evidence::age(group.masses, ageing::left_after(ms, ageing::Discounting::kConservative));
    }
    group.aged_ms = now_ms();
  }

  static void decide(PlainTile& tile, std::size_t group, const evidence::Indexes& indexes) {
    PlainGroup& eight = tile.groups[group];
    const decision::Bits bits =
        decision::decide(eight.masses, eight.ruled_out, indexes, eight.decided);
    for (std::size_t i = 0; i < indexes.size(); ++i) {
      GroundCell& cell = tile.ground[group * indexes.size() + i];
      cell.freed = (bits.freed >> i & 1) != 0;
      cell.seen = (bits.seen >> i & 1) != 0;
      cell.stands = (bits.stands >> i & 1) != 0;
      cell.taken = (bits.taken >> i & 1) != 0;
    }
  }

  struct GroupEvidence {
    evidence::Indexes indexes{};
    std::uint8_t moved = 0;
  };

  void fuse(const Evidence& evidence, const Moved& moved) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::map<std::size_t, GroupEvidence>> tiles;
    for (const auto& [at, said] : evidence) {
      const auto [y, x] = at;
      const std::pair tile{numeric::div_floor(y, kSide), numeric::div_floor(x, kSide)};
      const std::int32_t in_tile = (y - tile.first * kSide) * kSide + x - tile.second * kSide;
      GroupEvidence& group = tiles[tile][static_cast<std::size_t>(in_tile / 8)];
      group.indexes[static_cast<std::size_t>(in_tile % 8)] = static_cast<std::int8_t>(said.index);
      const auto found = moved.find(at);
      if (found != moved.end() && found->second) {
        group.moved = static_cast<std::uint8_t>(group.moved | 1U << in_tile % 8);
      }
    }
    for (const auto& [number, groups] : tiles) {
      const auto [place, is_new] = tiles_.try_emplace(number);
      if (is_new) {
        place->second.refreshed_frame = frames_;
      }
      for (const auto& [group, what] : groups) {
        fuse_group(place->second, group, what);
      }
    }
  }

  void fuse_group(PlainTile& tile, std::size_t number, const GroupEvidence& what) {
    PlainGroup& group = tile.groups[number];
    age(group);
    const std::uint64_t since = group.evidence_ms ? now_ms() - *group.evidence_ms : 100;
    const auto gain_ms = static_cast<std::size_t>(std::clamp<std::uint64_t>(since, 1, 100));
    evidence::fuse(group.masses, evidence::Fading{}, what.indexes, what.moved,
                   ageing::kGainsByTime[gain_ms]);
    group.evidence_ms = now_ms();
    decide(tile, number, what.indexes);
    fused_groups_.push_back(&group);
  }

  void refresh() {
    for (auto& [number, tile] : tiles_) {
      if ((window::slot_of({number.second, number.first}) + frames_) % 8 != 0) {
        continue;
      }
      tile.refreshed_frame = frames_;
      for (std::size_t group = 0; group < tile.groups.size(); ++group) {
        PlainGroup& which = tile.groups[group];
        if (which.aged_ms && std::ranges::find(fused_groups_, &which) == fused_groups_.end()) {
          age(which);
          decide(tile, group, {});
        }
      }
    }
    fused_groups_.clear();
  }

  void remember() {
    const std::uint64_t period = now_us_ / 480'000;
    std::optional<std::uint64_t>& last = last_turns_[fused_ % 2];
    const bool is_new_period = last && *last != period;
    last = period;
    if (tiles_.empty()) {
      return;
    }
    Copy copy = flat_copy();
    copy.flat.find_shut();
    for (auto& [number, tile] : tiles_) {
      if ((window::slot_of({number.second, number.first}) + fused_) % 2 != 0) {
        continue;
      }
      for (std::int32_t i = 0; i < kSide * kSide; ++i) {
        const Cell cell{number.second * kSide - copy.low.x + i % kSide,
                        number.first * kSide - copy.low.y + i / kSide};
        tile.ground[static_cast<std::size_t>(i)] = copy.flat.remembered(cell, is_new_period);
      }
    }
  }

  bool is_from_below_;
  std::int32_t tall_within_;
  bool looks_over_things_;
  Looks looks_;
  window::Extent extent_;
  window::Area area_;
  bool is_placed_ = false;
  Tiles tiles_;
  std::uint64_t now_us_ = 0;
  std::uint32_t frames_ = 0;
  std::uint32_t fused_ = 0;
  std::array<std::optional<std::uint64_t>, 2> last_turns_;
  std::vector<const PlainGroup*> fused_groups_;
};

}  // namespace iog::tests
