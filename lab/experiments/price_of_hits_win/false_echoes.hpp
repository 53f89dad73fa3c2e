// Echoes that no solid sent, put among a frame's points, and points of scenes made by hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lab/evidence/frame_points.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/scanners/lux_scanner.hpp"

namespace iog::lab {

enum class TrueEcho : std::uint8_t {
  kComesLater,  // as the second echo of its beam: it marks and does not carve
  kIsLost,      // with those behind it
};

struct Rained {
  FramePoints points;
  std::uint64_t drops = 0;
};

// A drop of rain, not flagged as such, ahead of the first echo of this share of the beams, anywhere
// between a metre from the scanner and that echo. Later echoes of a beam follow its first.
[[nodiscard]] Rained with_rain(const FramePoints& points, const vehicle::Vehicle& vehicle,
                               double rate, TrueEcho fate, tools::Random& random);

// A plate across the car's x axis that one sensor sees and nobody else.
struct Ghost {
  std::size_t sensor = 0;
  double x_m = 0;           // in the vehicle frame
  double half_width_m = 0;  // to either side of the axis
};

// The sensor's beams that end behind the ghost end on it instead, with the LUX's noise.
[[nodiscard]] FramePoints with_ghost(const FramePoints& points, const tools::CatalogueEntry& car,
                                     const Ghost& ghost, tools::Random& random);

// A car with its LUX that stands at the world's origin.
class StandingCar {
 public:
  explicit StandingCar(const tools::CatalogueEntry& car);

  [[nodiscard]] FramePoints look_at(std::span<const tools::Solid> solids, tools::Random& random);

 private:
  std::vector<tools::LuxScanner> scanners_;
};

}  // namespace iog::lab
