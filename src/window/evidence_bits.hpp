// What is asked of the bytes of a tile of a frame's evidence (window/slice_byte.hpp), a bit a cell.
// evidence_bits.cpp says what; CMake chooses how, evidence_bits.cpp or evidence_bits_neon.cpp.
#pragma once

#include "window/frame_evidence.hpp"

namespace iog::window {

struct EvidenceBits {
  Plane hit;
  Plane free;
  Plane from_below;  // free, and freed from below
};

[[nodiscard]] EvidenceBits bits_of(const FrameEvidence::TileIndexes& tile);

}  // namespace iog::window
