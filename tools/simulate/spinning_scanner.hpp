// A simulated scanner that turns: what each of its beams measures of the solids around it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tools/simulate/random.hpp"
#include "tools/simulate/sensor_frame.hpp"
#include "tools/simulate/solid.hpp"
#include "vehicle/description.hpp"

namespace iog::tools {

class SpinningScanner {
 public:
  explicit SpinningScanner(const vehicle::SensorConfig& config)
      : mount_(frame_of(config.mount)), sigma_m_(config.sigma_m) {}

  // The world stands still for all beams until the next call. solids outlive them.
  void move_to(const EgoPose& ego, std::span<const Solid> solids);

  // How far the beam goes from the place where it starts, metres. along: its direction in the
  // sensor frame, of length 1; height_m: of its start, over the unit's origin along its up axis.
  // Empty: nothing comes back.
  [[nodiscard]] std::optional<double> measure(const Vector3& along, double height_m,
                                              Random& random) const;

 private:
  // Directions in the plan, of the world, to either side of its x axis.
  static constexpr std::size_t kColumns = 720;
  // A solid that a beam of a column may meet, nearest first.
  struct Candidate {
    double nearest;  // no point of it is nearer in the plan
    const Solid* solid;
  };

  void add_to_columns(const Solid& solid);

  SensorFrame mount_;  // in the vehicle
  double sigma_m_;
  SensorFrame frame_{};  // in the world
  std::array<std::vector<Candidate>, kColumns> columns_;
};

}  // namespace iog::tools
