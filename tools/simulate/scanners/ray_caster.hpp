// What the beams of one scanner meet: rays are cast into a scene, each at its own time, during some
// milliseconds in which everything moves straight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/simulate/scanners/point_truth.hpp"
#include "tools/simulate/scanners/sensor_frame.hpp"
#include "tools/simulate/world/moving_solid.hpp"
#include "tools/simulate/world/scene.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

// Where a ray ends.
struct Hit {
  double distance = kNoHit;  // metres along it
  Material material = Material::kGround;
  std::uint32_t thing = 0;  // Solid::thing
  bool moves = false;
};

class RayCaster {
 public:
  // For a scanner that is mounted so on the car. Times are seconds of the drive, from_s <= to_s;
  // if they are one, the world stands still, whatever time is asked for. What is all farther than
  // farthest_m in the plan is left out.
  RayCaster(const Scene& scene, const SensorFrame& mount, double from_s, double to_s,
            double farthest_m);

  // For a scanner in a world that stands still. solids and frame are the world's.
  RayCaster(const SensorFrame& frame, std::span<const Solid> solids, double farthest_m);

  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  // The scanner in the world.
  [[nodiscard]] SensorFrame frame_at(double time_s) const;

  // The nearest surface that the ray meets farther than `beyond`, the ground included. The ray
  // starts within kArm of the scanner's place at that time.
  static constexpr double kArm = 0.25;
  [[nodiscard]] Hit nearest(const Ray& ray, double time_s, double beyond = 0) const;

  [[nodiscard]] PointTruth truth_of(const Ray& ray, const Hit& hit) const;

 private:
  // Directions in the plan of the world, to either side of its x axis.
  static constexpr std::size_t kColumns = 720;
  // A solid that a ray of a column may meet, nearest first.
  struct Candidate {
    double nearest;  // no point of it is nearer in the plan
    const MovingSolid* solid;
    bool moves;
  };

  // slack_m: how far the scanner may be from where it is in the middle of the interval.
  void sort_into_columns(const SensorFrame& middle, double slack_m);
  [[nodiscard]] double distance_to_ground(const Ray& ray) const;
  [[nodiscard]] bool stands_still() const { return from_s_ == to_s_; }

  const Scene* scene_ = nullptr;
  SensorFrame mount_{};
  SensorFrame still_{};          // the scanner in a world that stands still
  mutable double asked_s_ = -1;  // of the last frame that was asked for
  mutable SensorFrame asked_{};
  double from_s_ = 0;
  double to_s_ = 0;
  double farthest_m_ = 0;
  std::vector<MovingSolid> solids_;
  std::array<std::vector<Candidate>, kColumns> columns_;
};

}  // namespace iog::tools
