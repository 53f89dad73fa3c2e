// One cell of the perception grid in double precision, after Kurdej 2015: a reference for the
// integers of src/evidence and src/decision, written for reading. Its test shows that it is the
// thesis's cell over all 64 sets (lab/reference/evidential) where the two mean the same.
//
// A mass is 0 ... 1, and what the four masses leave of 1 is ignorance.
#pragma once

#include <algorithm>

#include "lab/reference/cell_ageing.hpp"

namespace iog::lab::reference {

// Masses of free and of occupied, of which one is 0. Both 0: no evidence.
struct ReferenceEvidence {
  double free = 0;
  double occupied = 0;
};

// index: of the cell in this frame, joined over its slices, -127 ... 127. A hit is worth 111/128,
// which outlives one frame in which the cell is crossed.
inline ReferenceEvidence reference_evidence(int index, const ReferenceGains& gains) {
  if (index == 0) {
    return {};
  }
  return index < 0 ? ReferenceEvidence{.free = gains.free_mass}
                   : ReferenceEvidence{.occupied = 111.0 / 128};
}

struct ReferenceCell {
  double free = 0;         // F = {D, N}
  double occupied = 0;     // O = {I, M, S, U}
  double moving = 0;       // M = {M}
  double standing = 0;     // K = {I, S, U}
  double persistence = 0;  // the accumulator zeta, no mass

  [[nodiscard]] double taken() const { return occupied + moving + standing; }
  [[nodiscard]] double ignorance() const { return 1 - free - taken(); }

  void age(const ReferenceFading& left) {
    free *= left.free;
    occupied *= left.occupied;
    moving *= left.moving;
    standing *= left.standing;
    persistence *= left.persistence;
  }

  // One frame's evidence, after ageing. `moved` says where the conflict of a cell that was free and
  // is hit goes to: to what moves, else to what is occupied. The conflict of a cell that was
  // occupied and is crossed goes to ignorance. Without evidence nothing changes.
  void fuse(const ReferenceEvidence& evidence, bool moved, const ReferenceGains& gains) {
    if (evidence.free == 0 && evidence.occupied == 0) {
      return;
    }
    const double appeared = free * evidence.occupied;
    const double disappeared = taken() * evidence.free;
    const double unknown = ignorance();
    free = free * (1 - evidence.occupied) + unknown * evidence.free;
    occupied = occupied * (1 - evidence.free) + unknown * evidence.occupied;
    moving *= 1 - evidence.free;
    standing *= 1 - evidence.free;
    (moved ? moving : occupied) += appeared;
    accumulate(1 - appeared - disappeared, gains);
    specialise(gains);
  }

 private:
  void accumulate(double agreement, const ReferenceGains& gains) {
    const double risen = taken() * agreement * gains.persistence;
    const double fallen = (1 - taken()) * gains.decline;
    persistence = std::clamp(persistence + risen - fallen, 0.0, 1.0);
  }

  // Occupied sets alone: ignorance stays ignorance. What {M} loses has no set to go to.
  void specialise(const ReferenceGains& gains) {
    const double share = persistence * gains.specialisation;
    standing += occupied * share;
    occupied *= 1 - share;
    moving *= 1 - share;
  }
};

}  // namespace iog::lab::reference
