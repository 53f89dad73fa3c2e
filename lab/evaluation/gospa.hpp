// Generalised optimal sub-pattern assignment (Rahmathullah, Garcia-Fernandez, Svensson, FUSION
// 2017): how far a set of things that is reported is from the true one. With p = 1 and alpha = 2 it
// is a sum of metres in three parts.
#pragma once

#include <cstdint>
#include <span>

namespace iog::lab {

struct Vector2 {
  double x = 0;
  double y = 0;
};

[[nodiscard]] double distance(const Vector2& a, const Vector2& b);

// Of the assignment with the least sum. A pair that is cut_m or more apart is none: the true one is
// missed, the reported one false, and each of these counts as cut_m / 2.
struct Gospa {
  double place_m = 0;  // of all pairs together
  std::uint64_t missed = 0;
  std::uint64_t wrong = 0;

  [[nodiscard]] double sum_m(double cut_m) const {
    return place_m + cut_m / 2 * static_cast<double>(missed + wrong);
  }
};

[[nodiscard]] Gospa gospa(std::span<const Vector2> truth, std::span<const Vector2> reported,
                          double cut_m);

}  // namespace iog::lab
