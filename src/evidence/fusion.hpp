// Eight cells age, and take in the evidence of a frame. evidence/cell.hpp says what happens to each
// of them; CMake chooses how eight are done at once, fusion.cpp or fusion_neon.cpp.
#pragma once

#include <cstdint>

#include "evidence/assignment.hpp"
#include "evidence/factors.hpp"
#include "evidence/group.hpp"

namespace iog::evidence {

// What is left of the group's masses.
void age(Free& free, Taken& taken, const Fading& fading);

// What is left of the group's masses, and then the evidence of one frame; a cell with index 0 only
// ages. Bit i of `moved`: whoever is in cell i came there, so that a hit on free ground is one of
// {M}.
void fuse(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
          std::uint8_t moved, const Gains& gains);

// The same with masses by index.
void fuse(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
          std::uint8_t moved, const Gains& gains, const Assignment& assignment);

// What age() and fuse() do to a group of which nothing is taken, and no cell hit: all that is not F
// is 0 and stays 0. No index is above 0.
void age_free(Free& free, const Fading& fading);
void fuse_free(Free& free, const Fading& fading, const Indexes& indexes, const Gains& gains);

}  // namespace iog::evidence
