// The parts of price_of_hits_win, and what they share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/experiments/detection_quality/quality_choices.hpp"
#include "lab/experiments/experiment.hpp"

namespace iog::lab {

// Side by side in every table.
inline const std::array kPricedFusions{
    IndexFusion{}, IndexFusion{.policy = index::Quantisation::kNearest},
    IndexFusion{.rule = IndexRule::kBayes}, IndexFusion{.rule = IndexRule::kSequential}};

template <typename Value>
using ByFusion = std::array<Value, 4>;

// The cells whose centres lie between these coordinates in the vehicle frame.
[[nodiscard]] std::vector<std::size_t> cells_within(double x_low, double x_high, double y_low,
                                                    double y_high);

// Of the reference car's LUX: the indexes of those cells, in their order.
[[nodiscard]] std::vector<std::int32_t> fused_cells(const FrameEvidence& evidence,
                                                    const IndexFusion& fusion,
                                                    const std::vector<std::size_t>& cells);

[[nodiscard]] Table price_of_rain(const Input& input);    // drops that the sensor does not flag
[[nodiscard]] Table price_of_ghosts(const Input& input);  // what one of three sensors sees
[[nodiscard]] Table price_of_gaps(const Input& input);    // between hits

}  // namespace iog::lab
