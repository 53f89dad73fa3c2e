// A simulated ibeo LUX: what it would send of the solids around it.
//
// 100 degrees in steps of 0.5, four layers a scan, up to three echoes per beam. A unit of eight
// layers scans with the lower and the upper four of them in turns. A beam is as wide as the
// real one's: its left and right edge are followed apart, so that an edge gives two echoes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/scanners/ray_caster.hpp"
#include "tools/simulate/scanners/sensor_frame.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

inline constexpr std::int32_t kLuxEdgeTicks = 1600;  // 50 degrees to either side
inline constexpr std::int32_t kLuxStepTicks = 16;    // 0.5 degrees
inline constexpr std::size_t kLuxAzimuths = 2 * kLuxEdgeTicks / kLuxStepTicks + 1;
inline constexpr std::size_t kLuxLayers = 4;  // of a scan

// The points of a scan from left to right, and what is true of each.
struct LuxEchoes {
  std::vector<LuxPoint> points;
  std::vector<PointTruth> truth;
};

class LuxScanner {
 public:
  explicit LuxScanner(const description::SensorConfig& config);

  // Where it is on the car.
  [[nodiscard]] const SensorFrame& mount() const { return mount_; }

  // A scan that begins and ends at these seconds of the drive.
  [[nodiscard]] LuxEchoes scan(const RayCaster& rays, double from_s, double to_s, MirrorSide side,
                               Random& random);

 private:
  struct Echo {
    double distance;
    double strength;  // the share of the beam that meets it
    Material material;
    PointTruth truth;
  };
  using Echoes = std::vector<Echo>;
  // Directions in the sensor frame of the right and the left edge of every beam.
  using Edges = std::array<std::array<std::array<Vector3, 2>, kLuxLayers>, kLuxAzimuths>;

  void follow(const RayCaster& rays, const SensorFrame& frame, double time_s,
              const std::array<Vector3, 2>& edges, Random& random);
  void add_points(std::size_t column, std::size_t layer, Random& random, LuxEchoes& scan) const;

  SensorFrame mount_;  // in the vehicle
  [[nodiscard]] const Edges& edges_of(MirrorSide side) const {
    return edges_[side == MirrorSide::kRear ? 1 : 0];
  }

  std::array<Edges, 2> edges_{};  // by the side of the mirror
  Echoes echoes_;                 // of the beam that is followed
};

}  // namespace iog::tools
