// A simulated ibeo LUX: what it would send of the solids around it.
//
// 100 degrees in steps of 0.5, four layers a scan, up to three echoes per beam. A unit of eight
// layers scans with the lower and the upper four of them in turns. A beam is as wide as the
// real one's: its left and right edge are followed apart, so that an edge gives two echoes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/formats/lux/lux_scan.hpp"
#include "tools/simulate/moving_solid.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/sensor_frame.hpp"
#include "tools/simulate/solid.hpp"
#include "tools/simulate/traffic.hpp"
#include "vehicle/description.hpp"

namespace iog::tools {

inline constexpr std::int32_t kLuxEdgeTicks = 1600;  // 50 degrees to either side
inline constexpr std::int32_t kLuxStepTicks = 16;    // 0.5 degrees
inline constexpr std::size_t kLuxAzimuths = 2 * kLuxEdgeTicks / kLuxStepTicks + 1;
inline constexpr std::size_t kLuxLayers = 4;  // of a scan

// What a scanner meets while its mirror sweeps from left to right.
struct Sweep {
  std::array<EgoPose, kLuxAzimuths> ego;  // when each column of beams is sent, at equal intervals
  std::vector<MovingSolid> solids;        // from the first column to the last
};

class LuxScanner {
 public:
  explicit LuxScanner(const vehicle::SensorConfig& config);

  // The points of one scan, from left to right, as if all its beams were sent at once.
  [[nodiscard]] std::vector<LuxPoint> scan(const EgoPose& ego, std::span<const Solid> solids,
                                           MirrorSide side, Random& random);

  // The points of a scan that takes its time: car and solids move between its columns.
  [[nodiscard]] std::vector<LuxPoint> scan(const Sweep& sweep, MirrorSide side, Random& random);

 private:
  // A solid that a column of beams may meet, nearest first.
  struct Candidate {
    double nearest;  // no point of it is nearer
    const Solid* solid;
    const MovingSolid* mover;  // whose place at the column's time the solid is; nullptr: it stands
  };
  // How much more than its outline in the middle of the sweep a solid may take up.
  struct Slack {
    double metres = 0;
    std::ptrdiff_t columns = 0;
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
  // Directions in the sensor frame of the right and the left edge of every beam.
  using Edges = std::array<std::array<std::array<Vector3, 2>, kLuxLayers>, kLuxAzimuths>;

  void clear_columns();
  void add_to_columns(const SensorFrame& frame, const Solid& solid, const Slack& slack,
                      const Candidate& candidate);
  void sort_columns();
  void sort_into_columns(const Sweep& sweep);
  void place_movers(std::size_t column);
  void follow(const SensorFrame& frame, std::size_t column, const std::array<Vector3, 2>& edges,
              Random& random);
  [[nodiscard]] Hit first_hit(const Ray& ray, std::size_t column, double beyond) const;
  void add_points(std::size_t column, std::size_t layer, Random& random,
                  std::vector<LuxPoint>& points);

  SensorFrame mount_;  // in the vehicle
  std::array<double, kLuxAzimuths> tangents_{};
  [[nodiscard]] const Edges& edges_of(MirrorSide side) const {
    return edges_[side == MirrorSide::kRear ? 1 : 0];
  }

  std::array<Edges, 2> edges_{};  // by the side of the mirror
  std::array<std::vector<Candidate>, kLuxAzimuths> columns_;
  std::vector<Solid> placed_;  // the movers of one column, at its time
  Echoes echoes_;              // of the beam that is followed
};

}  // namespace iog::tools
