// Where the search for the ground begins.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tools/mount/ground_plane.hpp"

namespace iog::tools {

// Each metre of range weighs alike, however many returns it has: rings lie dense near the unit.
class MetreWeights {
 public:
  explicit MetreWeights(std::span<const RoadReturn> returns);

  [[nodiscard]] double of(const RoadReturn& point) const { return 1.0 / counts_[metre_of(point)]; }
  // That have returns to speak of.
  [[nodiscard]] std::size_t metres() const;

 private:
  static constexpr std::size_t kMetres = static_cast<std::size_t>(kFarthestRoadM);
  static std::size_t metre_of(const RoadReturn& point);

  std::array<int, kMetres> counts_{};
};

// Some of the planes, at most 10 degrees from level and 1 m from where the unit's height puts them,
// within 0.15 m of which the most returns lie; the best first.
[[nodiscard]] std::vector<GroundPlane> starts_of(std::span<const RoadReturn> returns,
                                                 double expected_m);

}  // namespace iog::tools
