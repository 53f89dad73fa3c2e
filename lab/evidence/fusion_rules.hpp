// The rules by which a frame's evidence becomes a grid: the two of docs/model.md, the thesis's own,
// and Bayes in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/evidence/projection.hpp"
#include "lab/evidence/values.hpp"

namespace iog::lab {

enum class IndexRule : std::uint8_t {
  kHitsWin,     // docs/model.md section 3, the default
  kBayes,       // docs/model.md section 3: all carving, then all marking
  kSequential,  // the thesis's: one sum after the other as the points come (equation 4.4)
};

// One index per cell of the grid, 0 where nothing is known. Every stored sum saturates at +-limit:
// 127 is the firmware's int8; a limit of 2^30 never saturates.
[[nodiscard]] std::vector<std::int32_t> fuse_indexes(const FrameEvidence& evidence,
                                                     const ByStep<std::int32_t>& values,
                                                     IndexRule rule, std::int32_t limit);

// One probability per cell of the grid by equation 3.2, 1/2 where nothing is known.
[[nodiscard]] std::vector<double> fuse_probabilities(const FrameEvidence& evidence,
                                                     const ByStep<double>& values);

}  // namespace iog::lab
