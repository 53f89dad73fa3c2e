// How a car leans on its springs when it brakes and when its wheels meet bumps, beyond what the
// road itself slopes.
#pragma once

#include <cstdint>

namespace iog::tools {

// Radians and metres.
struct Lean {
  double pitch = 0;  // positive: the nose is down
  double roll = 0;   // positive: the left side is up
  double heave_m = 0;
};

// Never more than 2 degrees either way, and no angle changes by more than 1 degree in 100 ms.
class Attitude {
 public:
  // The same seed makes the same bumps.
  explicit Attitude(std::uint64_t seed) : seed_(seed) {}

  [[nodiscard]] Lean at(double time_s) const;

 private:
  std::uint64_t seed_;
};

}  // namespace iog::tools
