// The ground of the simulated hills, by its place along the road and beside it.
#pragma once

#include <cstdint>

namespace iog::tools {

// Metres to the right of the centre line.
inline constexpr double kHillsKerb = 5.9;  // the middle of the kerb
inline constexpr double kHillsKerbWidth = 0.2;
inline constexpr double kHillsKerbHeight = 0.12;
// To the left: where the road ends.
inline constexpr double kHillsLeftEdge = 3.9;

// A profile of a Terrain.
class HillsGround {
 public:
  explicit HillsGround(std::uint64_t seed) : seed_(seed) {}

  // Metres; the road's middle is at 0 where an act begins.
  double operator()(double station, double left) const {
    return along(station) + across(station, left);
  }

  // Of the road's middle.
  [[nodiscard]] double along(double station) const;

 private:
  // Over the road's middle.
  [[nodiscard]] static double across(double station, double left);

  std::uint64_t seed_;
};

}  // namespace iog::tools
