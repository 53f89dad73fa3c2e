// A group by itself, for tests that do not keep many.
#pragma once

#include <cstddef>
#include <cstdint>

#include "decision/decision.hpp"
#include "evidence/cell.hpp"
#include "evidence/fusion.hpp"
#include "lab/reference/cell.hpp"

namespace iog::evidence {

struct Group : Taken {
  Free free{};
};

inline Cell cell_of(const Group& group, std::size_t i) { return cell_of(group.free, group, i); }
inline void put(Group& group, std::size_t i, const Cell& cell) { put(group.free, group, i, cell); }

// As a reference has it.
inline lab::reference::ReferenceCell reference_cell(const Group& group, std::size_t cell) {
  const auto mass = [&](const Masses& masses) { return masses[cell] / double{kCertain}; };
  return {.free = mass(group.free),
          .occupied = mass(group.occupied),
          .moving = mass(group.moving),
          .standing = mass(group.standing),
          .persistence = mass(group.persistence)};
}

inline void age(Group& group, const Fading& fading) { age(group.free, group, fading); }

template <typename... Assignments>
void fuse(Group& group, const Fading& fading, const Indexes& indexes, std::uint8_t moved,
          const Gains& gains, const Assignments&... assignments) {
  fuse(group.free, group, fading, indexes, moved, gains, assignments...);
}

}  // namespace iog::evidence

namespace iog::decision {

inline Bits decide(const evidence::Group& group, const RuledOut& ruled_out,
                   const evidence::Indexes& of_this_frame, Decided& decided) {
  return decide(group.free, group, ruled_out, of_this_frame, decided);
}

}  // namespace iog::decision
