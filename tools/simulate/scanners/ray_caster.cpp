#include "tools/simulate/scanners/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace iog::tools {
namespace {

constexpr double kTurning = 0.05;  // metres that a solid's corner goes by its own turn, at most

// Of a direction in the plan. It only chooses what a ray is asked for: a column more to either side
// covers what another machine's atan2 rounds otherwise.
std::ptrdiff_t column_of(double angle, std::size_t columns) {
  const double turns = angle / (2 * std::numbers::pi);
  return static_cast<std::ptrdiff_t>(
      std::floor((turns - std::floor(turns)) * static_cast<double>(columns)));
}

double distance_in_plan(const Vector3& a, const Vector3& b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  return std::sqrt(dx * dx + dy * dy);
}

// From its centre to its farthest corner, in the plan.
double reach_of(const Solid& solid) {
  return solid.form == Solid::Form::kCylinder ? solid.half_length
                                              : std::sqrt(solid.half_length * solid.half_length +
                                                          solid.half_width * solid.half_width);
}

}  // namespace

RayCaster::RayCaster(const Scene& scene, const SensorFrame& mount, double from_s, double to_s,
                     double farthest_m)
    : scene_(&scene),
      mount_(mount),
      still_(placed(mount, scene.ego_at(from_s))),
      from_s_(from_s),
      to_s_(to_s),
      farthest_m_(farthest_m),
      solids_(scene.solids_between(from_s, to_s)) {
  const SensorFrame middle = frame_at((from_s + to_s) / 2);
  const double way = std::max(distance_in_plan(still_.origin, middle.origin),
                              distance_in_plan(frame_at(to_s).origin, middle.origin));
  sort_into_columns(middle, stands_still() ? 0 : way + kTurning);
}

RayCaster::RayCaster(const SensorFrame& frame, std::span<const Solid> solids, double farthest_m)
    : still_(frame), farthest_m_(farthest_m) {
  for (const Solid& solid : solids) {
    solids_.push_back({solid, solid.at, solid.footing});
  }
  sort_into_columns(frame, 0);
}

// Beams that are sent together ask for one frame.
SensorFrame RayCaster::frame_at(double time_s) const {
  if (stands_still()) {
    return still_;
  }
  if (time_s != asked_s_) {
    asked_ = placed(mount_, scene_->ego_at(time_s));
    asked_s_ = time_s;
  }
  return asked_;
}

// All as in the middle of the interval, with as much slack as scanner and solids move until its
// ends.
void RayCaster::sort_into_columns(const SensorFrame& middle, double slack_m) {
  struct Seen {
    Candidate candidate;
    double distance;
    double reach;
    double angle;
  };
  std::vector<Seen> seen;
  for (const MovingSolid& mover : solids_) {
    const Solid solid = mover.at(0.5);
    const double dx = solid.at.x - middle.origin.x;
    const double dy = solid.at.y - middle.origin.y;
    const double distance = std::sqrt(dx * dx + dy * dy);
    const double reach = reach_of(solid) + (slack_m > 0 ? slack_m + mover.way() / 2 : 0);
    if (distance - reach <= farthest_m_) {
      seen.push_back(
          {{distance - reach, &mover, mover.moves()}, distance, reach + kArm, std::atan2(dy, dx)});
    }
  }
  std::ranges::stable_sort(seen, {}, [](const Seen& one) { return one.candidate.nearest; });
  constexpr auto kCount = static_cast<std::ptrdiff_t>(kColumns);
  for (const Seen& one : seen) {
    std::ptrdiff_t first = 0;
    std::ptrdiff_t count = kCount;
    if (one.distance > one.reach) {
      const double half = std::asin(one.reach / one.distance);
      first = column_of(one.angle - half, kColumns) - 1;
      count = std::min(kCount, static_cast<std::ptrdiff_t>(half / std::numbers::pi * kCount) + 4);
    }
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      columns_[static_cast<std::size_t>((first + i + kCount) % kCount)].push_back(one.candidate);
    }
  }
}

PointTruth RayCaster::truth_of(const Ray& ray, const Hit& hit) const {
  const Vector3 at = point_at(ray, hit.distance);
  if (hit.material == Material::kGround) {
    return {.what = PointClass::kGround, .at = at};
  }
  PointClass what = PointClass::kInfrastructure;
  if (hit.material == Material::kCar || hit.material == Material::kPerson) {
    what = hit.moves ? PointClass::kMoving : PointClass::kMovable;
  }
  return {what, hit.thing, at, at.z - (scene_ != nullptr ? scene_->ground_at(at.x, at.y) : 0)};
}

double RayCaster::distance_to_ground(const Ray& ray) const {
  if (scene_ != nullptr) {
    return scene_->distance_to_ground(ray, farthest_m_ + kArm);
  }
  return ray.along.z < 0 ? ray.from.z / -ray.along.z : kNoHit;
}

// A ray is never shorter than its plan, so what is nearer in the plan may be met first.
Hit RayCaster::nearest(const Ray& ray, double time_s, double beyond) const {
  Hit hit{.distance = distance_to_ground(ray)};
  const double share = stands_still() ? 0 : (time_s - from_s_) / (to_s_ - from_s_);
  const std::ptrdiff_t column = column_of(std::atan2(ray.along.y, ray.along.x), kColumns);
  for (const Candidate& candidate : columns_[static_cast<std::size_t>(column) % kColumns]) {
    if (candidate.nearest - kArm > hit.distance) {
      break;
    }
    const MovingSolid& solid = *candidate.solid;
    const double distance = distance_to(candidate.moves ? solid.at(share) : solid.begin, ray);
    if (distance > beyond && distance < hit.distance) {
      hit = {distance, solid.begin.material, solid.begin.thing,
             solid.way() > kStandingMps * (to_s_ - from_s_)};
    }
  }
  return hit;
}

}  // namespace iog::tools
