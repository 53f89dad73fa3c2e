// A group by itself, for tests that do not keep many.
#pragma once

#include <cstddef>
#include <cstdint>

#include "decision/decision.hpp"
#include "evidence/cell.hpp"
#include "evidence/fusion.hpp"

namespace iog::evidence {

struct Group : Taken {
  Free free{};
};

inline Cell cell_of(const Group& group, std::size_t i) { return cell_of(group.free, group, i); }
inline void put(Group& group, std::size_t i, const Cell& cell) { put(group.free, group, i, cell); }

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
