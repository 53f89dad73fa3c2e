#include "evidence/fusion.hpp"

#include <cstddef>

#include "evidence/cell.hpp"

namespace iog::evidence {

void age(Group& group, const Fading& fading) {
  for (std::size_t i = 0; i < kGroupCells; ++i) {
    put(group, i, aged(cell_of(group, i), fading));
  }
}

void fuse(Group& group, const Indexes& indexes, std::uint8_t moved, const Gains& gains,
          const Assignment& assignment) {
  for (std::size_t i = 0; i < kGroupCells; ++i) {
    if (indexes[i] != 0) {
      const Evidence evidence = evidence_of(indexes[i], gains, assignment);
      put(group, i, fused(cell_of(group, i), evidence, ((moved >> i) & 1) != 0, gains));
    }
  }
}

}  // namespace iog::evidence
