#include "tools/mount/ground_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "tools/mount/normal_equations.hpp"
#include "tools/mount/plane_starts.hpp"

namespace iog::tools {
namespace {

// What lies on the plane is looked for anew in each round.
struct Gate {
  double width_m;
  double rise;  // with the range
};
constexpr std::array kGates{Gate{0.25, 0.03}, Gate{0.15, 0.02}, Gate{0.08, 0.01}, Gate{0.06, 0},
                            Gate{0.06, 0}};

// Fewer returns, or nearer together, could be anything.
constexpr std::size_t kFewest = 200;
constexpr std::size_t kFewestMetres = 3;
constexpr double kLeastSpreadXM = 2;  // standard deviations
constexpr double kLeastSpreadYM = 0.5;

// So much of what is seen of the lane below bumpers is on the plane; else it is some other thing's
// side, or the road is not seen for traffic. Higher returns do not count: dense rings have more of
// a van ahead than of the whole road.
constexpr double kLeastShare = 0.5;
constexpr double kLowM = 0.3;
// Under a road there is nothing, but for a mirror image.
constexpr double kClearlyBelowM = 0.15;
constexpr double kMostBelow = 0.05;
// What is spread evenly within the last gate is off by 35 mm; a road has half of that.
constexpr double kMostResidualM = 0.025;
// The road's slope changes by a degree within 20 m at most: the car stands on that of one
// place, and most is seen of others.
constexpr double kMostBendPerM = 1 / 57.3 / 20;

// A part of a turn is enough to tell one start from another.
constexpr std::size_t kSampled = 1'500;

using Returns = std::vector<RoadReturn>;

double off_m(const GroundPlane& plane, const RoadReturn& point) {
  return point.z_m - (plane.along * point.x_m + plane.across * point.y_m - plane.below_m +
                      plane.bend_per_m * point.x_m * point.x_m / 2);
}

Returns sample_of(std::span<const RoadReturn> returns) {
  Returns sample;
  const std::size_t stride = returns.size() / kSampled + 1;
  for (std::size_t i = 0; i < returns.size(); i += stride) {
    sample.push_back(returns[i]);
  }
  return sample;
}

Returns on_plane(std::span<const RoadReturn> returns, const GroundPlane& plane, const Gate& gate) {
  Returns on;
  std::ranges::copy_if(returns, std::back_inserter(on), [&](const RoadReturn& point) {
    return std::abs(off_m(plane, point)) <
           gate.width_m + gate.rise * std::hypot(point.x_m, point.y_m);
  });
  return on;
}

std::optional<GroundPlane> plane_through(const Returns& returns, const MetreWeights& weights) {
  NormalEquations<4> equations;
  for (const RoadReturn& point : returns) {
    equations.add({point.x_m, point.y_m, 1, point.x_m * point.x_m / 2}, point.z_m,
                  weights.of(point));
  }
  const auto solution = equations.solution();
  if (!solution) {
    return std::nullopt;
  }
  return GroundPlane{.along = (*solution)[0],
                     .across = (*solution)[1],
                     .below_m = -(*solution)[2],
                     .bend_per_m = (*solution)[3]};
}

struct Settled {
  GroundPlane plane;
  Returns on;
};

// A metre in which most returns are of some other thing says little of the road.
std::optional<Settled> settled(std::span<const RoadReturn> returns, const GroundPlane& start) {
  const MetreWeights weights(returns);
  Settled found{.plane = start, .on = {}};
  for (const Gate& gate : kGates) {
    found.on = on_plane(returns, found.plane, gate);
    const std::optional<GroundPlane> plane = plane_through(found.on, weights);
    if (!plane) {
      return std::nullopt;
    }
    found.plane = *plane;
  }
  return found;
}

// The plane with the most on it, of those to which any start leads.
std::optional<Settled> best_of(std::span<const RoadReturn> returns, double expected_m) {
  const Returns sample = sample_of(returns);
  const MetreWeights weights(sample);
  std::optional<GroundPlane> best;
  double most = 0;
  for (const GroundPlane& start : starts_of(sample, expected_m)) {
    const std::optional<Settled> found = settled(sample, start);
    double weight = 0;
    for (const RoadReturn& point : found ? found->on : Returns{}) {
      weight += weights.of(point);
    }
    if (weight > most) {
      most = weight;
      best = found->plane;
    }
  }
  return best ? settled(returns, *best) : std::nullopt;
}

bool are_wide(const Returns& on) {
  const auto spread_m = [&](double RoadReturn::*axis) {
    double sum = 0;
    double squares = 0;
    for (const RoadReturn& point : on) {
      sum += point.*axis;
      squares += point.*axis * point.*axis;
    }
    const auto count = static_cast<double>(on.size());
    return std::sqrt(std::max(0.0, squares / count - sum / count * sum / count));
  };
  return on.size() >= kFewest && MetreWeights(on).metres() >= kFewestMetres &&
         spread_m(&RoadReturn::x_m) > kLeastSpreadXM && spread_m(&RoadReturn::y_m) > kLeastSpreadYM;
}

bool is_bottom(std::span<const RoadReturn> returns, const Settled& found) {
  const auto lower_than = [&](double height_m) {
    return static_cast<double>(std::ranges::count_if(
        returns, [&](const RoadReturn& point) { return off_m(found.plane, point) < height_m; }));
  };
  const auto on = static_cast<double>(found.on.size());
  return on >= kLeastShare * lower_than(kLowM) && lower_than(-kClearlyBelowM) <= kMostBelow * on;
}

double residual_of(const Settled& found) {
  double squares = 0;
  for (const RoadReturn& point : found.on) {
    squares += off_m(found.plane, point) * off_m(found.plane, point);
  }
  return std::sqrt(squares / static_cast<double>(found.on.size()));
}

}  // namespace

std::optional<GroundPlane> ground_plane_of(std::span<const RoadReturn> returns, double expected_m) {
  if (returns.size() < kFewest) {
    return std::nullopt;
  }
  std::optional<Settled> found = best_of(returns, expected_m);
  if (!found || !are_wide(found->on) || !is_bottom(returns, *found)) {
    return std::nullopt;
  }
  found->plane.residual_m = residual_of(*found);
  const bool is_road = found->plane.residual_m <= kMostResidualM &&
                       std::abs(found->plane.bend_per_m) <= kMostBendPerM;
  return is_road ? std::optional(found->plane) : std::nullopt;
}

}  // namespace iog::tools
