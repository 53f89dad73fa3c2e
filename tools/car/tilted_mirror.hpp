// Where beams go that a tilted mirror sends (ibeo LUX and SICK LD-MRS with eight layers).
//
// The mirror turns about an upright axis, half as fast as its beams, and its sides are tilted
// against that axis, so that straight ahead the front's beams look down by the unit's beam tilt t
// and the rear's up by it. To the side the tilt counts by another share,
//   elevation = that of the layer +- t sqrt(2) sin(45 deg - a / 2) = ... +- t (cos a/2 - sin a/2)
// at azimuth a: 0.48 of it at 50 degrees to the left, 1.33 at 50 to the right (SICK, libsick_ldmrs,
// LuxBase::getVAngleOfLayer; one driver alone says so, no recording of such a unit has been seen).
//
// A beam's end is a function base + forward cos a + left sin a of its azimuth (vehicle.hpp), and
// these are not quite: three coordinates of a unit vector are set right at three azimuths of the
// field of view, Chebyshev's nodes, and are off between. With tilts of at most 2 degrees the height
// is off by less than a thousandth of the range, the place in the plan by less than a 10,000th
// (tests/host/tools/car/tilted_mirror_test.cpp).
#pragma once

#include <array>
#include <cstddef>

#include "numeric/elementary.hpp"

namespace iog::description {

// Of the units that have one. Below, it is one with four layers.
inline constexpr double kLeastBeamTiltDeg = 0.2;
inline constexpr double kMostBeamTiltDeg = 2.0;

// How much of its tilt a beam has, upward by the rear. Radians.
constexpr double tilted_elevation(double elevation, bool looks_up, double tilt, double azimuth) {
  const double off = tilt * (numeric::cos(azimuth / 2) - numeric::sin(azimuth / 2));
  return looks_up ? elevation + off : elevation - off;
}

// Forward, left and up of a unit vector in the sensor frame: base + forward cos a + left sin a.
struct FittedDirections {
  std::array<double, 3> base{};
  std::array<double, 3> forward{};
  std::array<double, 3> left{};
};

// elevation_at(azimuth), and the ends of the field of view, in radians.
constexpr FittedDirections fit_directions(double rightmost, double leftmost, auto&& elevation_at) {
  using numeric::cos;
  using numeric::sin;
  const double middle = (rightmost + leftmost) / 2;
  const double node = (leftmost - rightmost) / 2 * cos(numeric::kPi / 6);
  const auto direction_at = [&](double off) -> std::array<double, 3> {
    const double azimuth = middle + off;
    const double elevation = elevation_at(azimuth);
    return {cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation)};
  };
  const auto at_right = direction_at(-node);
  const auto ahead = direction_at(0);
  const auto at_left = direction_at(node);
  FittedDirections fit;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Of azimuths from the middle, which is then turned back to azimuth 0.
    const double even = (ahead[axis] - (at_left[axis] + at_right[axis]) / 2) / (1 - cos(node));
    const double odd = (at_left[axis] - at_right[axis]) / (2 * sin(node));
    fit.base[axis] = ahead[axis] - even;
    fit.forward[axis] = even * cos(middle) - odd * sin(middle);
    fit.left[axis] = even * sin(middle) + odd * cos(middle);
  }
  return fit;
}

}  // namespace iog::description
