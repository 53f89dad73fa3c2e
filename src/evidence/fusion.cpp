#include "evidence/fusion.hpp"

#include <cstddef>

#include "evidence/cell.hpp"

namespace iog::evidence {
namespace {

// evidence_of_index: from an index to Evidence.
template <typename EvidenceOfIndex>
void fuse_cells(Group& group, const Indexes& indexes, std::uint8_t moved, const Gains& gains,
                EvidenceOfIndex&& evidence_of_index) {
  for (std::size_t i = 0; i < kGroupCells; ++i) {
    if (indexes[i] != 0) {
      const bool has_moved = ((moved >> i) & 1) != 0;
      put(group, i, fused(cell_of(group, i), evidence_of_index(indexes[i]), has_moved, gains));
    }
  }
}

}  // namespace

void age(Group& group, const Fading& fading) {
  for (std::size_t i = 0; i < kGroupCells; ++i) {
    put(group, i, aged(cell_of(group, i), fading));
  }
}

void fuse(Group& group, const Indexes& indexes, std::uint8_t moved, const Gains& gains) {
  fuse_cells(group, indexes, moved, gains,
             [&](index::OccupancyIndex index) { return evidence_of(index, gains); });
}

void fuse(Group& group, const Indexes& indexes, std::uint8_t moved, const Gains& gains,
          const Assignment& assignment) {
  fuse_cells(group, indexes, moved, gains,
             [&](index::OccupancyIndex index) { return evidence_of(index, gains, assignment); });
}

}  // namespace iog::evidence
