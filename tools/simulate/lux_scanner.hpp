// A simulated ibeo LUX: what it would send of the solids around it.
//
// 100 degrees in steps of 0.5, four layers, up to three echoes per beam. A beam is as wide as the
// real one's: its left and right edge are followed apart, so that an edge gives two echoes. The
// scan is taken as if all its beams were sent at its end; the sweep of 11 ms is not simulated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/formats/lux/lux_scan.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/solid.hpp"
#include "tools/simulate/traffic.hpp"
#include "vehicle/description.hpp"

namespace iog::tools {

inline constexpr std::int32_t kLuxEdgeTicks = 1600;  // 50 degrees to either side
inline constexpr std::int32_t kLuxStepTicks = 16;    // 0.5 degrees
inline constexpr std::size_t kLuxAzimuths = 2 * kLuxEdgeTicks / kLuxStepTicks + 1;
inline constexpr std::size_t kLuxLayers = 4;

class LuxScanner {
 public:
  explicit LuxScanner(const vehicle::SensorConfig& config);

  // The points of one scan, from left to right.
  [[nodiscard]] std::vector<LuxPoint> scan(const EgoPose& ego, std::span<const Solid> solids,
                                           Random& random);

 private:
  // The sensor's axes and place in the world.
  struct Frame {
    Vector3 origin;
    Vector3 forward;
    Vector3 left;
    Vector3 up;
  };
  // A solid that a column of beams may meet, nearest first.
  struct Candidate {
    double nearest;  // no point of it is nearer
    const Solid* solid;
  };
  struct Hit {
    double distance = kNoHit;
    Material material = Material::kGround;
  };
  struct Echo {
    double distance;
    double strength;  // the share of the beam that meets it
    Material material;
  };
  using Echoes = std::vector<Echo>;

  [[nodiscard]] Frame frame_of(const EgoPose& ego) const;
  void sort_into_columns(const Frame& frame, std::span<const Solid> solids);
  void follow(const Frame& frame, std::size_t column, std::size_t layer, Random& random);
  [[nodiscard]] Hit first_hit(const Ray& ray, std::size_t column, double beyond) const;
  void add_points(std::size_t column, std::size_t layer, Random& random,
                  std::vector<LuxPoint>& points);

  Frame mount_;  // in the vehicle
  std::array<double, kLuxAzimuths> tangents_{};
  // Directions in the sensor frame of the right and the left edge of every beam.
  std::array<std::array<std::array<Vector3, 2>, kLuxLayers>, kLuxAzimuths> edges_{};
  std::array<std::vector<Candidate>, kLuxAzimuths> columns_;
  Echoes echoes_;  // of the beam that is followed
};

}  // namespace iog::tools
