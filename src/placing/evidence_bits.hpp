// What is asked of the bytes of a tile of a frame's evidence (placing/slice_byte.hpp), a bit a
// cell. evidence_bits.cpp says what; CMake chooses how, evidence_bits.cpp or
// evidence_bits_neon.cpp.
#pragma once

#include "placing/frame_evidence.hpp"

namespace iog::placing {

struct EvidenceBits {
  window::Plane hit;
  window::Plane free;
  window::Plane from_below;  // free, and freed from below
};

[[nodiscard]] EvidenceBits bits_of(const FrameEvidence::TileIndexes& tile);

}  // namespace iog::placing
