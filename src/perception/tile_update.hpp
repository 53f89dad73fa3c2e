// Updates groups of eight cells. An update ages the cells of a group, fuses the frame's evidence
// into them and classifies them.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "ageing/clock.hpp"
#include "decision/decision.hpp"
#include "evidence/assignment.hpp"
#include "evidence/fusion.hpp"
#include "window/tile.hpp"

namespace iog::perception {

// Evidence that is at least kLongAgoFrames frames old is recorded as too old (kNever). Frames are
// at least 4 ms apart, so evidence of this age is more than 100 ms old. The exact age of such
// evidence therefore has no effect. Refreshes are frequent enough to record kNever before the clock
// reuses the frame's slot.
inline constexpr unsigned kLongAgoFrames = 32;

// Returns the bits of a plane that belong to a group's cells.
[[nodiscard]] inline std::uint8_t eight_of(const window::Plane& plane, std::size_t group) {
  return static_cast<std::uint8_t>(std::as_bytes(std::span(plane))[group]);
}
inline void set_eight(window::Plane& plane, std::size_t group, std::uint8_t bits) {
  static_assert(std::endian::native == std::endian::little, "the first group is the lowest byte");
  std::as_writable_bytes(std::span(plane))[group] = std::byte{bits};
}

// A word that contains one byte for each of two or four consecutive groups of a row.
template <std::size_t kGroups>
using Joint = std::conditional_t<kGroups == 4, std::uint32_t, std::uint16_t>;

// `bytes` has one byte per group of a tile. The number of the first group must be a multiple of
// kGroups.
template <std::size_t kGroups, typename Bytes>
[[nodiscard]] inline Joint<kGroups> joint(const Bytes& bytes, std::size_t group) {
  Joint<kGroups> word = 0;
  __builtin_memcpy(
      &word, __builtin_assume_aligned(std::as_bytes(std::span(bytes)).data() + group, sizeof(word)),
      sizeof(word));
  return word;
}
template <std::size_t kGroups, typename Bytes>
inline void set_joint(Bytes& bytes, std::size_t group, std::uint32_t value) {
  const auto word = static_cast<Joint<kGroups>>(value);
  __builtin_memcpy(__builtin_assume_aligned(std::as_writable_bytes(std::span(bytes)).data() + group,
                                            sizeof(word)),
                   &word, sizeof(word));
}

class TileUpdate {
 public:
  // Updates tiles for the newest frame of `clock`. If `assignment` is null, all hits have the same
  // mass. Both arguments must outlive this object.
  TileUpdate(const ageing::Clock& clock, const evidence::Assignment* assignment)
      : clock_(&clock), assignment_(assignment), now_(clock.now()) {
    for (std::size_t slot = 0; slot < gains_.size(); ++slot) {
      gains_[slot] = &clock.gains(static_cast<std::uint8_t>(slot));
    }
  }

  // Fuses evidence into a group. Bit i of `moved` refers to cell i. If the group was never aged,
  // its stored masses have no effect.
  void fuse(window::Tile& tile, std::size_t group, const evidence::Indexes& indexes,
            std::uint8_t moved) const {
    evidence::Free& free = tile.free[group];
    evidence::Taken& taken = tile.taken[group];
    const evidence::Fading& fading = clock_->since(tile.aged_at[group]);
    const evidence::Gains& gains = *gains_[tile.evidence_at[group]];
    if (assignment_ == nullptr) {
      evidence::fuse(free, taken, fading, indexes, moved, gains);
    } else {
      evidence::fuse(free, taken, fading, indexes, moved, gains, *assignment_);
    }
    tile.aged_at[group] = now_;
    tile.evidence_at[group] = now_;
    decide(tile, group, indexes);
  }

  // Returns true if cross() may replace fuse() for a group without hits.
  [[nodiscard]] bool needs_no_taken(const window::Tile& tile, std::size_t group) const {
    return tile.is_free_alone[group] && assignment_ == nullptr;
  }

  // Equivalent to fuse() if needs_no_taken() is true and no cell of the group is hit.
  void cross(window::Tile& tile, std::size_t group, const evidence::Indexes& indexes) const {
    evidence::fuse_free(tile.free[group], clock_->since(tile.aged_at[group]), indexes,
                        *gains_[tile.evidence_at[group]]);
    tile.aged_at[group] = now_;
    tile.evidence_at[group] = now_;
    decide_free(tile, group, indexes);
  }

  // Returns true if kGroups consecutive groups can be processed at once. In this case,
  // needs_no_taken() is true for all of them, and all have the same Tile::aged_at and
  // Tile::evidence_at.
  template <std::size_t kGroups>
  [[nodiscard]] bool may_be_joint(const window::Tile& tile, std::size_t group) const {
    const auto are_equal = [](Joint<kGroups> bytes) { return std::rotr(bytes, 8) == bytes; };
    return joint<kGroups>(tile.is_free_alone, group) == static_cast<Joint<kGroups>>(kOnes) &&
           are_equal(joint<kGroups>(tile.aged_at, group)) &&
           are_equal(joint<kGroups>(tile.evidence_at, group)) && assignment_ == nullptr;
  }

  // Same as above, but processes kGroups consecutive groups at once. may_be_joint() must be true.
  // `indexes` refers to the indexes of the first group. Those of the other groups follow in memory.
  template <std::size_t kGroups>
  void cross(window::Tile& tile, std::size_t group, const evidence::Indexes& indexes) const {
    cross_joint<kGroups>(tile, group, indexes);
    set_joint<kGroups>(tile.evidence_at, group, now_ * kOnes);
  }

  // Returns true if the group is known and was not fused in this frame.
  [[nodiscard]] bool is_old(const window::Tile& tile, std::size_t group) const {
    return tile.is_known(group) && tile.aged_at[group] != now_;
  }

  // Same as calling refresh() for each group of a row. All groups must be old, and may_be_joint()
  // must be true.
  void refresh_row(window::Tile& tile, std::size_t group) const {
    static constexpr std::array<evidence::Indexes, window::kGroupsPerRow> kNone{};
    const std::uint8_t evidence_at = tile.evidence_at[group];
    cross_joint<window::kGroupsPerRow>(tile, group, kNone.front());
    if (is_long_ago(evidence_at)) {
      set_joint<window::kGroupsPerRow>(tile.evidence_at, group, ageing::Clock::kNever * kOnes);
    }
  }

  // Ages and classifies an old group without evidence.
  void refresh(window::Tile& tile, std::size_t group) const {
    const evidence::Fading& fading = clock_->since(tile.aged_at[group]);
    tile.aged_at[group] = now_;
    if (is_long_ago(tile.evidence_at[group])) {
      tile.evidence_at[group] = ageing::Clock::kNever;
    }
    if (tile.is_free_alone[group]) {
      evidence::age_free(tile.free[group], fading);
      decide_free(tile, group, evidence::Indexes{});
    } else {
      evidence::age(tile.free[group], tile.taken[group], fading);
      decide(tile, group, evidence::Indexes{});
    }
  }

 private:
  static constexpr std::uint32_t kOnes = 0x0101'0101;

  template <std::size_t kGroups>
  void cross_joint(window::Tile& tile, std::size_t group, const evidence::Indexes& indexes) const {
    const std::uint64_t bits =
        decision::cross_free<kGroups>({.free = &tile.free[group],
                                       .fading = &clock_->since(tile.aged_at[group]),
                                       .indexes = &indexes,
                                       .gains = gains_[tile.evidence_at[group]],
                                       .ruled_out = &tile.ruled_out_in(group),
                                       .decided = &tile.decided[group]});
    set_joint<kGroups>(tile.aged_at, group, now_ * kOnes);
    set_joint<kGroups>(tile.found.freed, group, static_cast<std::uint32_t>(bits));
    set_joint<kGroups>(tile.found.seen, group, static_cast<std::uint32_t>(bits >> 32));
  }

  static void decide(window::Tile& tile, std::size_t group, const evidence::Indexes& indexes) {
    const decision::Bits bits =
        decision::decide(tile.free[group], tile.taken[group], tile.ruled_out_in(group), indexes,
                         tile.decided[group]);
    tile.is_free_alone[group] = bits.held == 0;
    set_eight(tile.found.freed, group, bits.freed);
    set_eight(tile.found.seen, group, bits.seen);
    set_eight(tile.found.stands, group, bits.stands);
    set_eight(tile.found.taken, group, bits.taken);
  }

  // Classifies a group in which the `stands` and `taken` bits are already 0.
  static void decide_free(window::Tile& tile, std::size_t group, const evidence::Indexes& indexes) {
    const decision::FreeBits bits = decision::decide_free(
        tile.free[group], tile.ruled_out_in(group), indexes, tile.decided[group]);
    set_eight(tile.found.freed, group, bits.freed);
    set_eight(tile.found.seen, group, bits.seen);
  }

  [[nodiscard]] bool is_long_ago(std::uint8_t slot) const {
    constexpr unsigned kFrames = ageing::Clock::kFrames;
    return (now_ + kFrames - slot) % kFrames >= kLongAgoFrames;
  }

  const ageing::Clock* clock_;
  const evidence::Assignment* assignment_;
  std::uint8_t now_;
  std::array<const evidence::Gains*, ageing::Clock::kFrames + 1> gains_{};  // by slot
};

}  // namespace iog::perception
