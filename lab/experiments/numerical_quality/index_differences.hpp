// How far the probabilities that indexes stand for are from those of a fusion in double precision,
// cell by cell on the same evidence: what table 4.6 of the thesis is about.
#pragma once

#include <cstdint>
#include <vector>

#include "index/recursive_set.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/evidence/values.hpp"

namespace iog::lab {

// |p_integer - p_float| of the cells of some grids.
struct Differences {
  std::uint64_t cells = 0;  // all
  std::uint64_t known = 0;  // those of which some beam says another probability than 1/2
  double sum = 0;
  double squares = 0;
  double sum_known = 0;
  double squares_known = 0;
  double sum_near = 0;            // in cells nearer to a scan point than its free ones
  double largest = 0;             // of all
  std::uint32_t largest_of = 0;   // how many measurements the cell of it has
  std::uint64_t above_bound = 0;  // larger than the cell's number of measurements times epsilon
  std::int64_t largest_index = 0;

  [[nodiscard]] double mean() const { return sum / static_cast<double>(cells); }
  [[nodiscard]] double mean_of_known() const { return sum_known / static_cast<double>(known); }
  [[nodiscard]] double standard_deviation() const;
  [[nodiscard]] double root_mean_square_of_known() const;
};

// One recursive set and one policy.
struct QuantisedModel {
  QuantisedModel(const ByStep<double>& model, double of_epsilon, index::Quantisation of_policy);

  // |p_n - p| of the 1D cell at this step: what the quantisation does to one measurement.
  [[nodiscard]] double error_at(const ByStep<double>& model, int step) const;

  double epsilon;
  index::Quantisation policy;
  ByStep<std::int32_t> values;
  double log_odds_step;  // of p_1: those of p_n are n times as much
  Differences differences;
};

// Adds a frame to the differences of each of them. Both fusions take the same evidence: the indexes
// by their sum without saturation, the probabilities by equation 3.2.
void compare(const FrameEvidence& evidence, const ByStep<double>& model,
             std::vector<QuantisedModel>& quantised);

}  // namespace iog::lab
