// What a frame does to eight cells: they age, take in evidence, and are decided.
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

namespace iog::window {

// Evidence that is so many frames old is long ago. Every group is looked at often enough to find it
// so before the clock's slot is used again, and what is 100 ms old counts as long ago anyway:
// frames are 4 ms apart or more.
inline constexpr unsigned kLongAgoFrames = 32;

// The evidence of a group in the frame that ended now.
struct GroupEvidence {
  evidence::Indexes indexes{};
  std::uint8_t moved = 0;  // bit i is of cell i
};

// The bits of a group's cells in a plane.
[[nodiscard]] inline std::uint8_t eight_of(const Plane& plane, std::size_t group) {
  return static_cast<std::uint8_t>(std::as_bytes(std::span(plane))[group]);
}
inline void set_eight(Plane& plane, std::size_t group, std::uint8_t bits) {
  static_assert(std::endian::native == std::endian::little, "the first group is the lowest byte");
  std::as_writable_bytes(std::span(plane))[group] = std::byte{bits};
}

class TileUpdate {
 public:
  // For the frame that ended now by the clock. Without an assignment all hits have one mass. Both
  // outlive it.
  TileUpdate(const ageing::Clock& clock, const evidence::Assignment* assignment)
      : clock_(&clock), assignment_(assignment), now_(clock.now()) {
    for (std::size_t slot = 0; slot < gains_.size(); ++slot) {
      gains_[slot] = &clock.gains(static_cast<std::uint8_t>(slot));
    }
  }

  // The group has evidence.
  void fuse(Tile& tile, std::size_t group, const GroupEvidence& what) const {
    if (tile.is_known(group)) {
      age(tile, group);
    } else {
      tile.groups[group] = {};
      tile.aged_at[group] = now_;
    }
    evidence::Group& cells = tile.groups[group];
    const evidence::Gains& gains = *gains_[tile.evidence_at[group]];
    if (assignment_ == nullptr) {
      evidence::fuse(cells, what.indexes, what.moved, gains);
    } else {
      evidence::fuse(cells, what.indexes, what.moved, gains, *assignment_);
    }
    tile.evidence_at[group] = now_;
    decide(tile, group, what.indexes);
  }

  // The group has none, unless it was fused in this frame. False if nothing was to do.
  bool refresh(Tile& tile, std::size_t group) const {
    if (!tile.is_known(group) || tile.aged_at[group] == now_) {
      return false;
    }
    age(tile, group);
    if (is_long_ago(tile.evidence_at[group])) {
      tile.evidence_at[group] = ageing::Clock::kNever;
    }
    decide(tile, group, evidence::Indexes{});
    return true;
  }

 private:
  void age(Tile& tile, std::size_t group) const {
    evidence::age(tile.groups[group], clock_->since(tile.aged_at[group]));
    tile.aged_at[group] = now_;
  }

  static void decide(Tile& tile, std::size_t group, const evidence::Indexes& indexes) {
    const decision::Bits bits = decision::decide(tile.groups[group], indexes);
    set_eight(tile.found.freed, group, bits.freed);
    set_eight(tile.found.seen, group, bits.seen);
    set_eight(tile.found.stands, group, bits.stands);
    set_eight(tile.found.taken, group, bits.taken);
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

}  // namespace iog::window
