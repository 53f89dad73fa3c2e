// The inverse sensor model across a wide beam, such as a radar beam. The model determines which
// occupancy indexes a detection assigns to the cells to its left and right.
//
// Along the beam, the model of single_target.hpp applies. If the target is in the direction of the
// beam, cell k of the beam is occupied with probability P(o_k | z). The direction of the target has
// a Gaussian distribution. Directions are divided into angular cells, just as the beam is divided
// into 1D cells. The width of an angular cell equals the standard deviation of this distribution,
// and the detection is at the centre of angular cell 0. The target is in angular cell a with weight
//
//   w_a = exp(-a^2 / 2) / sum_b exp(-b^2 / 2).
//
// With weight 1 - w_a, the target is elsewhere, and nothing is known about cell a:
//
//   P(o_a | z) = w_a * P(o_k | z) + (1 - w_a) / 2.
//
// For a radar, the cells in front of the target and behind it get no index, because a radar detects
// objects behind other objects and around corners, and it does not report every object
// (docs/model.md, section 10).
//
// An ultrasonic sensor measures no direction, so the Gaussian represents its cone. The sensor
// reports only the first echo, and it detects an object in its cone with probability h. A cell in
// front of the target has returned no echo. With a prior of 1/2, the probability that this cell is
// occupied is therefore
//
//   P(o | z) = (1 - h) / (2 - h)
//
// (docs/model.md, section 11).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "index/occupancy_index.hpp"
#include "index/recursive_set.hpp"
#include "numeric/elementary.hpp"
#include "sensor_model/profile.hpp"

namespace iog::sensor_model {

// Angular cell 3 never gets an index: its weight is only 0.004, but even the smallest epsilon of
// any car (0.01) requires a weight of 0.01.
inline constexpr std::size_t kMaxArcCells = 3;

// The detection probability h of an ultrasonic sensor. Such a sensor often misses cloth, foam, thin
// poles, and planes that reflect the sound away from it. The value is deliberately low, so that a
// detection outweighs a missing echo.
inline constexpr double kHeard = 0.2;

struct Arc {
  std::uint16_t cell_ticks = 0;  // width of an angular cell in ticks of the sensor
  std::uint8_t count = 0;        // number of cells per side that get an index, including cell 0
  std::array<index::OccupancyIndex, kMaxArcCells> marks{};  // indexes from the centre outward;
                                                            // above 0 and never increasing
  index::OccupancyIndex free = 0;  // index of the cone in front of the target; at most 0, and
                                   // always 0 for a radar

  // Returns true if the sensor is a radar or an ultrasonic sensor.
  [[nodiscard]] constexpr bool is_given() const { return count > 0; }

  // Returns the largest offset from the detection's azimuth that is still inside an angular cell,
  // in ticks.
  [[nodiscard]] constexpr std::int32_t reach_ticks() const {
    return ((2 * std::int32_t{count} - 1) * cell_ticks - 1) / 2;
  }
  // Returns the index at the offset `off_ticks` from the detection's azimuth. The magnitude of the
  // offset must be at most reach_ticks(). An offset on the border between two cells belongs to the
  // outer one.
  [[nodiscard]] constexpr index::OccupancyIndex at(std::int32_t off_ticks) const {
    const std::int32_t off = off_ticks < 0 ? -off_ticks : off_ticks;
    return marks[static_cast<std::size_t>((2 * off + cell_ticks) / (2 * std::int32_t{cell_ticks}))];
  }

  [[nodiscard]] constexpr bool is_valid() const {
    bool valid = count <= kMaxArcCells && cell_ticks > 0;
    for (std::size_t a = 0; valid && a < count; ++a) {
      valid = marks[a] > 0 && (a == 0 || marks[a] <= marks[a - 1]);
    }
    return valid && count > 0 && free <= 0;
  }

  friend constexpr bool operator==(const Arc&, const Arc&) = default;
};

// Computes an arc. If even cell 0 gets no index, `count` is 0 in the result.
constexpr Arc arc_of(const ProfileConfig& config, std::uint16_t cell_ticks) {
  const double hit = SingleTarget{config.sigma_m, config.cell_length_m}.probability(0);
  const index::RecursiveSet set(config.epsilon);
  double sum = 0;
  for (int b = -12; b <= 12; ++b) {
    sum += numeric::exp(-0.5 * b * b);
  }
  Arc arc{.cell_ticks = cell_ticks};
  for (std::size_t a = 0; a < kMaxArcCells; ++a) {
    const auto distance = static_cast<double>(a);
    const double weight = numeric::exp(-0.5 * distance * distance) / sum;
    const std::int32_t index = set.quantise(0.5 + weight * (hit - 0.5), config.quantisation);
    if (index <= 0) {
      break;
    }
    arc.marks[a] = static_cast<index::OccupancyIndex>(index);
    arc.count = static_cast<std::uint8_t>(a + 1);
  }
  return arc;
}

// Returns the index of a cell from which an ultrasonic sensor received no echo. Returns 0 if even
// the weakest index of the set would be too strong.
constexpr index::OccupancyIndex unheard(const ProfileConfig& config) {
  const index::RecursiveSet set(config.epsilon);
  return static_cast<index::OccupancyIndex>(
      set.quantise((1 - kHeard) / (2 - kHeard), config.quantisation));
}

}  // namespace iog::sensor_model
