// The inverse sensor model across a wide beam, such as that of a radar: the occupancy indexes that
// a detection gives to the cells beside it.
//
// Along the beam, single_target.hpp applies: if the target is in this direction, its 1D cell k is
// occupied with P(o_k | z). The direction of the target is Gaussian. Directions are cut into
// angular cells, as the beam is cut into 1D cells. An angular cell is as long as the standard
// deviation, and the detection is in the middle of angular cell 0. The target is in angular cell a
// with the weight
//
//   w_a = exp(-a^2 / 2) / sum_b exp(-b^2 / 2).
//
// With the weight 1 - w_a it is elsewhere, and then nothing is known about cell a:
//
//   P(o_a | z) = w_a P(o_k | z) + (1 - w_a) / 2
//
// Cells before and behind the target get no index. A radar sees past objects and round corners, and
// does not report everything that is there (docs/model.md, section 10).
//
// An ultrasonic unit gives no direction, so the Gaussian is its cone. It reports the first echo. It
// hears an object in its cone with probability h. With a prior of 1/2, a cell before the target,
// from which nothing was heard, is therefore occupied with
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

// At the smallest epsilon of a car, 0.01, cell 3 would need a weight of 0.01. It has 0.004.
inline constexpr std::size_t kMaxArcCells = 3;

// h of an ultrasonic unit. It often does not hear cloth, foam, thin poles, and planes that reflect
// the sound away. The value is low on purpose, so that a detection outweighs silence.
inline constexpr double kHeard = 0.2;

struct Arc {
  std::uint16_t cell_ticks = 0;  // length of an angular cell, in ticks of the sensor
  std::uint8_t count = 0;        // cells to each side that get an index, cell 0 included
  std::array<index::OccupancyIndex, kMaxArcCells> marks{};  // by distance; above 0, not increasing
  index::OccupancyIndex free = 0;  // of the cone before the target; at most 0, and 0 for a radar

  // Whether the sensor is a radar or an ultrasonic unit.
  [[nodiscard]] constexpr bool is_given() const { return count > 0; }

  // The largest offset in whole ticks from the detection's azimuth that lies in one of these cells.
  [[nodiscard]] constexpr std::int32_t reach_ticks() const {
    return ((2 * std::int32_t{count} - 1) * cell_ticks - 1) / 2;
  }
  // The index at this offset, which is at most reach_ticks(). A border belongs to the outer cell.
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

// The count is 0 if not even cell 0 can be marked.
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

// The index of a cell from which an ultrasonic unit heard nothing. 0 if even the weakest index of
// the set would say more.
constexpr index::OccupancyIndex unheard(const ProfileConfig& config) {
  const index::RecursiveSet set(config.epsilon);
  return static_cast<index::OccupancyIndex>(
      set.quantise((1 - kHeard) / (2 - kHeard), config.quantisation));
}

}  // namespace iog::sensor_model
