// The parts of price_of_hits_win, and what they share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lab/experiments/quality_choices.hpp"
#include "lab/experiments/section.hpp"

namespace iog::lab {

// Side by side in every table of the section.
inline const std::array kPricedFusions{
    IndexFusion{}, IndexFusion{.policy = index::Quantisation::kNearest},
    IndexFusion{.rule = IndexRule::kBayes}, IndexFusion{.rule = IndexRule::kSequential}};
inline constexpr std::size_t kHitsWinPlace = 0;
inline constexpr std::size_t kNearestPlace = 1;
inline constexpr std::size_t kBayesPlace = 2;

template <typename Value>
using ByFusion = std::array<Value, 4>;

// A table's head: these columns, then one for each fusion.
[[nodiscard]] std::vector<std::string> columns_before_fusions(std::vector<std::string> columns);

// The cells whose centres lie between these coordinates in the vehicle frame.
[[nodiscard]] std::vector<std::size_t> cells_within(double x_low, double x_high, double y_low,
                                                    double y_high);

// Of the reference car's LUX: the indexes of those cells, in their order.
[[nodiscard]] std::vector<std::int32_t> fused_cells(const FrameEvidence& evidence,
                                                    const IndexFusion& fusion,
                                                    const std::vector<std::size_t>& cells);

void describe_rain(const TablesInput& input, Section& section);
void describe_ghosts(const TablesInput& input, Section& section);
void describe_gaps(const TablesInput& input, Section& section);

}  // namespace iog::lab
