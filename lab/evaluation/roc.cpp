#include "lab/evaluation/roc.hpp"

#include <algorithm>

namespace iog::lab {
namespace {

// (score, is occupied) of the cells that could be seen, the highest score first: equal scores stand
// side by side, so that the map is asked once for each of them.
template <typename Value>
std::vector<std::pair<double, bool>> sorted_scores(std::span<const CellState> truth,
                                                   std::span<const Value> values) {
  std::vector<std::pair<double, bool>> scores;
  for (std::size_t cell = 0; cell < truth.size(); ++cell) {
    if (truth[cell] != CellState::kUnknown) {
      scores.emplace_back(static_cast<double>(values[cell]), truth[cell] == CellState::kOccupied);
    }
  }
  std::ranges::sort(scores, std::greater<>());
  return scores;
}

}  // namespace

void Roc::add(std::span<const CellState> truth, std::span<const std::int32_t> indexes) {
  add_sorted(sorted_scores(truth, indexes));
}

void Roc::add(std::span<const CellState> truth, std::span<const double> probabilities) {
  add_sorted(sorted_scores(truth, probabilities));
}

void Roc::add_sorted(std::span<const std::pair<double, bool>> scores) {
  auto place = by_score_.end();
  for (const auto& [score, is_occupied] : scores) {
    if (place == by_score_.end() || place->first != score) {
      place = by_score_.try_emplace(score).first;
    }
    ++(is_occupied ? place->second.occupied : place->second.free);
  }
}

Roc::Counts Roc::total() const {
  Counts sum;
  for (const auto& [score, counts] : by_score_) {
    sum.free += counts.free;
    sum.occupied += counts.occupied;
  }
  return sum;
}

double Roc::area() const {
  const Counts all = total();
  if (all.free == 0 || all.occupied == 0) {
    return 0.5;
  }
  // Twice the number of pairs won, so that a tie is 1. Some 1e5 times 1e7 pairs: far below 2^64.
  std::uint64_t won = 0;
  std::uint64_t free_below = all.free;
  for (const auto& [score, counts] : by_score_) {
    free_below -= counts.free;
    won += counts.occupied * (2 * free_below + counts.free);
  }
  return static_cast<double>(won) /
         (2 * static_cast<double>(all.free) * static_cast<double>(all.occupied));
}

std::pair<double, double> Roc::share_of(const Counts& part, const Counts& all) {
  return {static_cast<double>(part.free) / static_cast<double>(all.free),
          static_cast<double>(part.occupied) / static_cast<double>(all.occupied)};
}

std::vector<std::pair<double, double>> Roc::curve() const {
  const Counts all = total();
  Counts above;
  std::vector<std::pair<double, double>> points{{0, 0}};
  for (const auto& [score, counts] : by_score_) {
    above.free += counts.free;
    above.occupied += counts.occupied;
    points.push_back(share_of(above, all));
  }
  return points;
}

std::pair<double, double> Roc::at_least(double score) const {
  Counts above;
  for (const auto& [each, counts] : by_score_) {
    if (each >= score) {
      above.free += counts.free;
      above.occupied += counts.occupied;
    }
  }
  return share_of(above, total());
}

double Roc::recall_within(double free_share) const {
  double recall = 0;
  for (const auto& [free, occupied] : curve()) {
    if (free <= free_share) {
      recall = occupied;
    }
  }
  return recall;
}

}  // namespace iog::lab
