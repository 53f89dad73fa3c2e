// Ages eight cells and fuses a frame's evidence into them. `evidence/cell.hpp` specifies the result
// for each cell. CMake selects one of two implementations of these functions: fusion.cpp or
// fusion_neon.cpp.
#pragma once

#include <cstdint>

#include "evidence/assignment.hpp"
#include "evidence/factors.hpp"
#include "evidence/group.hpp"

namespace iog::evidence {

// Ages the group's masses.
void age(Free& free, Taken& taken, const Fading& fading);

// Ages the group's masses, and then fuses the evidence of one frame. A cell with index 0 is only
// aged. Bit i of `moved` is set if the object in cell i has moved into this cell. In this case, a
// hit in a free cell adds mass to {M}.
void fuse(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
          std::uint8_t moved, const Gains& gains);

// Same as above, but the masses are graded by index.
void fuse(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
          std::uint8_t moved, const Gains& gains, const Assignment& assignment);

// Same as age() and fuse(), but for a group without occupied mass or hits. All masses except F are
// 0 and stay 0. All indexes must be 0 or negative.
void age_free(Free& free, const Fading& fading);
void fuse_free(Free& free, const Fading& fading, const Indexes& indexes, const Gains& gains);

}  // namespace iog::evidence
