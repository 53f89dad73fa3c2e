#include "tools/simulate/lux_scanner.hpp"

#include <algorithm>
#include <cmath>

#include "lidar/ibeo_lux.hpp"
#include "numeric/elementary.hpp"
#include "tools/simulate/echo_model.hpp"
#include "vehicle/scanner_facts.hpp"
#include "vehicle/tilted_mirror.hpp"

namespace iog::tools {
namespace {

constexpr double kHalfBeam = 0.04 * numeric::kPi / 180;  // radians; the LUX's beam is 0.08 degrees
constexpr double kInFront = 0.05;                        // metres ahead of the sensor
constexpr double kSeparation = 0.9;  // echoes nearer to one another than this are one
constexpr double kFoliagePass = 0.45;

double angle_of(std::size_t column) {
  const auto ticks = kLuxEdgeTicks - static_cast<std::int32_t>(column) * kLuxStepTicks;
  return ticks * 2 * numeric::kPi / lidar::IbeoLux::kTicksPerTurn;
}

// The outline of a solid, seen from the sensor in a plane: how near it comes, and between which
// tangents y / x of direction it lies.
struct Outline {
  double nearest = 0;
  double low = 0;
  double high = 0;
  bool is_in_front = false;
};

Outline outline_of(double x, double y, double reach_x, double reach_y, double reach) {
  Outline outline;
  outline.nearest = std::sqrt(x * x + y * y) - reach;
  outline.is_in_front = x + reach_x > kInFront;
  if (x - reach_x <= kInFront) {
    outline.low = -kNoHit;
    outline.high = kNoHit;
    return outline;
  }
  const double right = y - reach_y;
  const double left = y + reach_y;
  outline.low = right / (right > 0 ? x + reach_x : x - reach_x);
  outline.high = left / (left > 0 ? x - reach_x : x + reach_x);
  return outline;
}

}  // namespace

LuxScanner::LuxScanner(const vehicle::SensorConfig& config) : mount_(frame_of(config.mount)) {
  const double tilt = vehicle::radians(config.beam_tilt_deg);
  for (std::size_t column = 0; column < kLuxAzimuths; ++column) {
    const double angle = angle_of(column);
    tangents_[column] = -numeric::sin(angle) / numeric::cos(angle);  // ascending to the right
    for (std::size_t layer = 0; layer < kLuxLayers; ++layer) {
      const double flat = lidar::IbeoLux::kElevationsDeg[layer] * numeric::kPi / 180;
      for (const bool looks_up : {false, true}) {
        const double elevation = vehicle::tilted_elevation(flat, looks_up, tilt, angle);
        for (std::size_t edge = 0; edge < 2; ++edge) {
          const double azimuth = edge == 0 ? angle - kHalfBeam : angle + kHalfBeam;
          edges_[looks_up ? 1 : 0][column][layer][edge] = {
              numeric::cos(elevation) * numeric::cos(azimuth),
              numeric::cos(elevation) * numeric::sin(azimuth), numeric::sin(elevation)};
        }
      }
    }
  }
}

void LuxScanner::clear_columns() {
  for (auto& column : columns_) {
    column.clear();
  }
}

// Adds a solid to the columns of beams that may meet it, so that a beam asks only few. A column of
// margin on both sides covers the beam's width and the pitch's effect on azimuth.
void LuxScanner::add_to_columns(const SensorFrame& frame, const Solid& solid, const Slack& slack,
                                const Candidate& candidate) {
  const double norm =
      std::sqrt(frame.forward.x * frame.forward.x + frame.forward.y * frame.forward.y);
  const Placement sensor{.x = frame.origin.x,
                         .y = frame.origin.y,
                         .cos = frame.forward.x / norm,
                         .sin = frame.forward.y / norm};
  const double dx = solid.at.x - sensor.x;
  const double dy = solid.at.y - sensor.y;
  const double turn_cos = std::abs(solid.at.cos * sensor.cos + solid.at.sin * sensor.sin);
  const double turn_sin = std::abs(solid.at.sin * sensor.cos - solid.at.cos * sensor.sin);
  const bool is_box = solid.form == Solid::Form::kBox;
  const double length = solid.half_length;
  const double width = solid.half_width;
  const Outline outline =
      outline_of(dx * sensor.cos + dy * sensor.sin, dy * sensor.cos - dx * sensor.sin,
                 (is_box ? length * turn_cos + width * turn_sin : length) + slack.metres,
                 (is_box ? length * turn_sin + width * turn_cos : length) + slack.metres,
                 (is_box ? std::sqrt(length * length + width * width) : length) + slack.metres);
  if (!outline.is_in_front || outline.nearest > kLuxFarthest) {
    return;
  }
  const auto first = std::ranges::lower_bound(tangents_, -outline.high) - tangents_.begin();
  const auto last = std::ranges::upper_bound(tangents_, -outline.low) - tangents_.begin();
  const auto end = std::min<std::ptrdiff_t>(last + 1 + slack.columns, kLuxAzimuths);
  for (auto column = std::max<std::ptrdiff_t>(first - 1 - slack.columns, 0); column < end;
       ++column) {
    columns_[static_cast<std::size_t>(column)].push_back(
        {outline.nearest, candidate.solid, candidate.mover});
  }
}

void LuxScanner::sort_columns() {
  for (auto& column : columns_) {
    std::ranges::stable_sort(column, {}, &Candidate::nearest);
  }
}

// All as in the middle of the sweep, with as much slack as car and solids move until its ends.
void LuxScanner::sort_into_columns(const Sweep& sweep) {
  constexpr double kTurning = 0.05;  // metres that a solid's corner goes by its own turn, at most
  const double column_sin = numeric::sin(-angle_of(1) + angle_of(0));
  clear_columns();
  const SensorFrame middle = placed(mount_, sweep.ego[kLuxAzimuths / 2]);
  double way = 0;
  double turn_sin = 0;
  for (const EgoPose* const pose : {&sweep.ego.front(), &sweep.ego.back()}) {
    const SensorFrame end = placed(mount_, *pose);
    const double dx = end.origin.x - middle.origin.x;
    const double dy = end.origin.y - middle.origin.y;
    way = std::max(way, std::sqrt(dx * dx + dy * dy));
    turn_sin = std::max(
        turn_sin, std::abs(end.forward.x * middle.forward.y - end.forward.y * middle.forward.x));
  }
  const auto turned_columns = static_cast<std::ptrdiff_t>(turn_sin / column_sin) + 1;
  for (const MovingSolid& mover : sweep.solids) {
    const double own_way = mover.way() / 2;
    add_to_columns(middle, mover.at(0.5), {way + own_way + kTurning, turned_columns},
                   {0, &mover.begin, mover.moves() ? &mover : nullptr});
  }
  sort_columns();
}

// Puts the movers of that column where they are when it is sent.
void LuxScanner::place_movers(std::size_t column) {
  const double share = static_cast<double>(column) / (kLuxAzimuths - 1);
  placed_.clear();
  placed_.reserve(columns_[column].size());  // so that none of them changes its address
  for (Candidate& candidate : columns_[column]) {
    if (candidate.mover != nullptr) {
      placed_.push_back(candidate.mover->at(share));
      candidate.solid = &placed_.back();
    }
  }
}

// Distances along a beam and in the plan differ by less than a thousandth here; the margin below
// covers it.
LuxScanner::Hit LuxScanner::first_hit(const Ray& ray, std::size_t column, double beyond) const {
  Hit hit;
  if (ray.along.z < 0) {
    hit.distance = ray.from.z / -ray.along.z;
  }
  for (const Candidate& candidate : columns_[column]) {
    if (candidate.nearest > hit.distance) {
      break;
    }
    const double distance = distance_to(*candidate.solid, ray);
    if (distance > beyond && distance < hit.distance) {
      hit = {distance, candidate.solid->material};
    }
  }
  return hit;
}

// Finds the echoes of one beam, nearest first and apart from one another.
void LuxScanner::follow(const SensorFrame& frame, std::size_t column,
                        const std::array<Vector3, 2>& edges, Random& random) {
  echoes_.clear();
  std::array<Hit, 2> hits;
  for (std::size_t edge = 0; edge < 2; ++edge) {
    const Ray ray{frame.origin, frame.direction(edges[edge])};
    hits[edge] = first_hit(ray, column, 0);
    if (hits[edge].material == Material::kFoliage && random.chance(kFoliagePass)) {
      const double beyond = hits[edge].distance + random.between(0.2, 1.5);
      const Hit behind = first_hit(ray, column, beyond);
      echoes_.push_back({behind.distance, 0.3, behind.material});
    }
  }
  const double gap = std::abs(hits[0].distance - hits[1].distance);
  if (gap < 0.3 + 0.05 * std::min(hits[0].distance, hits[1].distance)) {
    const double middle = (hits[0].distance + hits[1].distance) / 2;
    echoes_.push_back({middle, 1.0, hits[0].material});
  } else {
    echoes_.push_back({hits[0].distance, 0.5, hits[0].material});
    echoes_.push_back({hits[1].distance, 0.5, hits[1].material});
  }
  std::ranges::stable_sort(echoes_, {}, &Echo::distance);
}

void LuxScanner::add_points(std::size_t column, std::size_t layer, Random& random,
                            std::vector<LuxPoint>& points) {
  const auto ticks = kLuxEdgeTicks - static_cast<std::int32_t>(column) * kLuxStepTicks;
  LuxPoint point{.layer = static_cast<std::uint8_t>(layer),
                 .angle_ticks = static_cast<std::int16_t>(ticks)};
  if (add_clutter(random, point)) {
    points.push_back(point);
    ++point.echo;
  }
  double last = -kSeparation;
  for (const Echo& echo : echoes_) {
    if (echo.distance - last < kSeparation || point.echo >= lidar::IbeoLux::kMaxEchoes ||
        !comes_back(echo.material, echo.distance, echo.strength, random)) {
      continue;
    }
    last = echo.distance;
    measure(echo.material, echo.distance, echo.strength, random, point);
    points.push_back(point);
    ++point.echo;
  }
}

std::vector<LuxPoint> LuxScanner::scan(const EgoPose& ego, std::span<const Solid> solids,
                                       MirrorSide side, Random& random) {
  const SensorFrame frame = placed(mount_, ego);
  clear_columns();
  for (const Solid& solid : solids) {
    add_to_columns(frame, solid, {}, {0, &solid, nullptr});
  }
  sort_columns();
  std::vector<LuxPoint> points;
  for (std::size_t column = 0; column < kLuxAzimuths; ++column) {
    for (std::size_t layer = 0; layer < kLuxLayers; ++layer) {
      follow(frame, column, edges_of(side)[column][layer], random);
      add_points(column, layer, random, points);
    }
  }
  return points;
}

std::vector<LuxPoint> LuxScanner::scan(const Sweep& sweep, MirrorSide side, Random& random) {
  sort_into_columns(sweep);
  std::vector<LuxPoint> points;
  for (std::size_t column = 0; column < kLuxAzimuths; ++column) {
    const SensorFrame frame = placed(mount_, sweep.ego[column]);
    place_movers(column);
    for (std::size_t layer = 0; layer < kLuxLayers; ++layer) {
      follow(frame, column, edges_of(side)[column][layer], random);
      add_points(column, layer, random, points);
    }
  }
  return points;
}

}  // namespace iog::tools
