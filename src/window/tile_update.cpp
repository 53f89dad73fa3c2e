#include "window/tile_update.hpp"

#include "decision/decision.hpp"
#include "evidence/fusion.hpp"

namespace iog::window {
namespace {

// A group that is known.
void age_group(Tile& tile, std::size_t group, const ageing::Clock& clock) {
  const std::uint8_t aged = tile.aged_at[group];
  if (clock.ms_since(aged) != 0) {
    evidence::age(tile.groups[group], clock.since(aged));
  }
  tile.aged_at[group] = clock.now();
}

void set_eight(Plane& plane, std::size_t group, std::uint8_t bits) {
  const std::size_t shift = group % kGroupsPerRow * evidence::kGroupCells;
  std::uint32_t& row = plane[group / kGroupsPerRow];
  row = (row & ~(std::uint32_t{0xFF} << shift)) | std::uint32_t{bits} << shift;
}

void decide_group(Tile& tile, std::size_t group, const evidence::Indexes& indexes) {
  const decision::Bits bits = decision::decide(tile.groups[group], indexes);
  set_eight(tile.found.freed, group, bits.freed);
  set_eight(tile.found.seen, group, bits.seen);
  set_eight(tile.found.stands, group, bits.stands);
  set_eight(tile.found.taken, group, bits.taken);
}

bool is_long_ago(std::uint8_t slot, const ageing::Clock& clock) {
  constexpr unsigned kFrames = ageing::Clock::kFrames;
  return (clock.now() + kFrames - slot) % kFrames >= kLongAgoFrames;
}

}  // namespace

void fuse_group(Tile& tile, std::size_t group, const GroupEvidence& what,
                const ageing::Clock& clock, const evidence::Assignment* assignment) {
  evidence::Group& cells = tile.groups[group];
  if (tile.is_known(group)) {
    age_group(tile, group, clock);
  } else {
    cells = {};
    tile.aged_at[group] = clock.now();
  }
  const evidence::Gains& gains = clock.gains(tile.evidence_at[group]);
  if (assignment == nullptr) {
    evidence::fuse(cells, what.indexes, what.moved, gains);
  } else {
    evidence::fuse(cells, what.indexes, what.moved, gains, *assignment);
  }
  tile.evidence_at[group] = clock.now();
  decide_group(tile, group, what.indexes);
}

bool refresh_group(Tile& tile, std::size_t group, const ageing::Clock& clock) {
  if (!tile.is_known(group)) {
    return false;
  }
  age_group(tile, group, clock);
  if (is_long_ago(tile.evidence_at[group], clock)) {
    tile.evidence_at[group] = ageing::Clock::kNever;
  }
  decide_group(tile, group, evidence::Indexes{});
  return true;
}

}  // namespace iog::window
