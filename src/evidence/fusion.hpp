// Eight cells age, and take in the evidence of a frame. evidence/cell.hpp says what happens to each
// of them; CMake chooses how eight are done at once, fusion.cpp or fusion_neon.cpp.
#pragma once

#include <cstdint>

#include "evidence/assignment.hpp"
#include "evidence/factors.hpp"
#include "evidence/group.hpp"

namespace iog::evidence {

// What is left of the group's masses. ruled_out and decided stay.
void age(Group& group, const Fading& fading);

// The evidence of one frame in a group that is aged already; a cell with index 0 stays as it is.
// Bit i of `moved`: whoever is in cell i came there, so that a hit on free ground is one of {M}.
void fuse(Group& group, const Indexes& indexes, std::uint8_t moved, const Gains& gains);

// The same with masses by index.
void fuse(Group& group, const Indexes& indexes, std::uint8_t moved, const Gains& gains,
          const Assignment& assignment);

}  // namespace iog::evidence
