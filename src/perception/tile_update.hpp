// Updates a group of eight cells in a frame by ageing the cells, fusing evidence into them and
// classifying them.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ageing/clock.hpp"
#include "decision/decision.hpp"
#include "evidence/assignment.hpp"
#include "evidence/fusion.hpp"
#include "window/tile.hpp"

namespace iog::perception {

// Evidence that is at least kLongAgoFrames frames old is recorded as too old (kNever). Frames are
// at least 4 ms apart, so evidence of this age is more than 100 ms old, and its exact age has no
// effect. Groups are refreshed often enough to record old evidence before the clock reuses the
// slot.
inline constexpr unsigned kLongAgoFrames = 32;

// Returns the bits of a group's cells in a plane.
[[nodiscard]] inline std::uint8_t eight_of(const window::Plane& plane, std::size_t group) {
  return static_cast<std::uint8_t>(std::as_bytes(std::span(plane))[group]);
}
inline void set_eight(window::Plane& plane, std::size_t group, std::uint8_t bits) {
  static_assert(std::endian::native == std::endian::little, "the first group is the lowest byte");
  std::as_writable_bytes(std::span(plane))[group] = std::byte{bits};
}

class TileUpdate {
 public:
  // Updates tiles for the frame that has just ended according to the clock. If `assignment` is
  // null, all hits have the same mass. Both arguments must outlive this object.
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

  // Has the same effect as fuse() if needs_no_taken() is true and no cell of the group is hit.
  void cross(window::Tile& tile, std::size_t group, const evidence::Indexes& indexes) const {
    evidence::fuse_free(tile.free[group], clock_->since(tile.aged_at[group]), indexes,
                        *gains_[tile.evidence_at[group]]);
    tile.aged_at[group] = now_;
    tile.evidence_at[group] = now_;
    decide_free(tile, group, indexes);
  }

  // Has the same effect as the function above, for two groups at once.
  void cross(window::Tile& tile, std::array<std::size_t, 2> groups,
             std::array<const evidence::Indexes*, 2> indexes) const {
    const auto crossed = [&](std::size_t i) -> decision::Crossed {
      const std::size_t group = groups[i];
      return {.free = &tile.free[group],
              .fading = &clock_->since(tile.aged_at[group]),
              .indexes = indexes[i],
              .gains = gains_[tile.evidence_at[group]],
              .ruled_out = &tile.ruled_out_in(group),
              .decided = &tile.decided[group]};
    };
    const std::array<decision::FreeBits, 2> bits = decision::cross_free({crossed(0), crossed(1)});
    for (std::size_t i = 0; i < groups.size(); ++i) {
      tile.aged_at[groups[i]] = now_;
      tile.evidence_at[groups[i]] = now_;
      set_eight(tile.found.freed, groups[i], bits[i].freed);
      set_eight(tile.found.seen, groups[i], bits[i].seen);
    }
  }

  // Returns true if the group is known and was not fused in this frame.
  [[nodiscard]] bool is_old(const window::Tile& tile, std::size_t group) const {
    return tile.is_known(group) && tile.aged_at[group] != now_;
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

  // Classifies a group whose bits for standing and occupied are already 0.
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
