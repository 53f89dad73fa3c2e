// Extracts bit planes from a tile of a frame's evidence (placing/slice_byte.hpp).
// `evidence_bits.cpp` is the reference implementation. CMake selects either evidence_bits.cpp or
// evidence_bits_neon.cpp.
#pragma once

#include "placing/frame_evidence.hpp"

namespace iog::placing {

struct EvidenceBits {
  window::Plane hit;
  window::Plane free;
  window::Plane from_below;  // free, and freed by a low beam
};

[[nodiscard]] EvidenceBits bits_of(const FrameEvidence::TileIndexes& tile);

}  // namespace iog::placing
