// The receiver operating characteristic of a grid: how the visibly occupied cells are told from the
// visibly free ones as the threshold goes from certain to anything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "lab/evaluation/cell_state.hpp"

namespace iog::lab {

class Roc {
 public:
  // Adds a frame: the index or the probability of a cell is its score. Cells that could not be seen
  // are left out; what the grid does not know scores 0 or 1/2.
  void add(std::span<const CellState> truth, std::span<const std::int32_t> indexes);
  void add(std::span<const CellState> truth, std::span<const double> probabilities);

  // The area under the curve: the share of the pairs of an occupied and a free cell in which the
  // occupied one scores higher, a tie counting half (Mann and Whitney's U). 1/2 without pairs.
  [[nodiscard]] double area() const;

  // (share of the free cells, share of the occupied cells) that score at least as much, for every
  // score from the highest, from (0, 0) to (1, 1). Some of each class must have been added.
  [[nodiscard]] std::vector<std::pair<double, double>> curve() const;

  // The same for one threshold.
  [[nodiscard]] std::pair<double, double> at_least(double score) const;

  // The largest share of the occupied cells at any threshold that takes in at most this share of
  // the free ones.
  [[nodiscard]] double recall_within(double free_share) const;

 private:
  struct Counts {
    std::uint64_t free = 0;
    std::uint64_t occupied = 0;
  };

  void add_sorted(std::span<const std::pair<double, bool>> scores);
  [[nodiscard]] Counts total() const;
  [[nodiscard]] static std::pair<double, double> share_of(const Counts& part, const Counts& all);

  std::map<double, Counts, std::greater<>> by_score_;
};

}  // namespace iog::lab
