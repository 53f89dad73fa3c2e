// The inverse sensor model across a wide beam, as a radar has it: which occupancy indexes a
// detection gives to the cells beside it.
//
// The way along the beam is that of single_target.hpp: if the target is in this direction, its 1D
// cell k is occupied with P(o_k | z). Which direction it is in is a Gaussian. Directions are cut
// into angular cells as long as its standard deviation, as the way is cut into 1D cells, and the
// detection stands in the middle of angular cell 0. So cell a is the target's with the weight
//
//   w_a = exp(-a^2 / 2) / sum_b exp(-b^2 / 2),
//
// and with 1 - w_a it is not, of which nothing is known of cell a:
//
//   P(o_a | z) = w_a P(o_k | z) + (1 - w_a) / 2
//
// The cells before the target and behind it get no index: a radar sees past things and round
// corners, and what it does not report may be there (docs/model.md, section 10).
//
// An ultrasonic unit says no direction at all, and the Gaussian is its cone. It reports what it
// hears first. A thing in its cone is heard with the probability h, so of a cell before the target,
// from which nothing was heard,
//
//   P(o | z) = (1 - h) / (2 - h)
//
// with a prior of 1/2 (docs/model.md, section 11).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "index/occupancy_index.hpp"
#include "index/recursive_set.hpp"
#include "numeric/elementary.hpp"
#include "sensor_model/profile.hpp"

namespace iog::sensor_model {

// With the least epsilon that a car may have, 0.01, cell 3 would need a weight of 0.01; it has
// 0.004.
inline constexpr std::size_t kMaxArcCells = 3;

// Of an ultrasonic unit, h. Cloth, foam, thin poles, and planes that throw the sound elsewhere are
// often not heard; it is low on purpose, so that a detection outweighs what was not heard.
inline constexpr double kHeard = 0.2;

struct Arc {
  std::uint16_t cell_ticks = 0;  // length of an angular cell, in ticks of the sensor
  std::uint8_t count = 0;        // cells to either side that get an index, cell 0 included
  std::array<index::OccupancyIndex, kMaxArcCells> marks{};  // by distance; above 0, never rising
  index::OccupancyIndex free = 0;  // of the cone before the target; at most 0, of a radar 0

  // Of a radar or an ultrasonic unit.
  [[nodiscard]] constexpr bool is_given() const { return count > 0; }

  // How far from the detection's azimuth whole ticks are in one of these cells.
  [[nodiscard]] constexpr std::int32_t reach_ticks() const {
    return ((2 * std::int32_t{count} - 1) * cell_ticks - 1) / 2;
  }
  // The index of a direction that is so far away, at most reach_ticks(). On a border that of the
  // outer cell.
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

// One of which not even cell 0 can be marked has a count of 0.
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

// The index of what an ultrasonic unit has not heard; 0 if the least of the set says more.
constexpr index::OccupancyIndex unheard(const ProfileConfig& config) {
  const index::RecursiveSet set(config.epsilon);
  return static_cast<index::OccupancyIndex>(
      set.quantise((1 - kHeard) / (2 - kHeard), config.quantisation));
}

}  // namespace iog::sensor_model
