#include "evidence/fusion.hpp"

#include <cstddef>

#include "evidence/cell.hpp"

namespace iog::evidence {
namespace {

// evidence_of_index: converts an index to Evidence.
template <typename EvidenceOfIndex>
void fuse_cells(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
                std::uint8_t moved, const Gains& gains, EvidenceOfIndex&& evidence_of_index) {
  age(free, taken, fading);
  for (std::size_t i = 0; i < kGroupCells; ++i) {
    if (indexes[i] != 0) {
      const bool has_moved = ((moved >> i) & 1) != 0;
      const Cell before = cell_of(free, taken, i);
      put(free, taken, i, fused(before, evidence_of_index(indexes[i]), has_moved, gains));
    }
  }
}

}  // namespace

void age(Free& free, Taken& taken, const Fading& fading) {
  for (std::size_t i = 0; i < kGroupCells; ++i) {
    put(free, taken, i, aged(cell_of(free, taken, i), fading));
  }
}

void fuse(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
          std::uint8_t moved, const Gains& gains) {
  fuse_cells(free, taken, fading, indexes, moved, gains,
             [&](index::OccupancyIndex index) { return evidence_of(index, gains); });
}

void fuse(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
          std::uint8_t moved, const Gains& gains, const Assignment& assignment) {
  fuse_cells(free, taken, fading, indexes, moved, gains,
             [&](index::OccupancyIndex index) { return evidence_of(index, gains, assignment); });
}

void age_free(Free& free, const Fading& fading) {
  Taken nothing;
  age(free, nothing, fading);
}

void fuse_free(Free& free, const Fading& fading, const Indexes& indexes, const Gains& gains) {
  Taken nothing;
  fuse(free, nothing, fading, indexes, 0, gains);
}

}  // namespace iog::evidence
