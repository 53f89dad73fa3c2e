#include "tools/simulate/spinning_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/simulate/echo_model.hpp"

namespace iog::tools {
namespace {

constexpr double kFarthest = 120;  // metres; the data sheets of Velodyne's say 70 to 120

// Of a direction in the plan. It only chooses what a beam is asked for: a column more to either
// side covers what another machine's atan2 rounds otherwise.
std::ptrdiff_t column_of(double angle, std::size_t columns) {
  const double turns = angle / (2 * std::numbers::pi);
  return static_cast<std::ptrdiff_t>(
      std::floor((turns - std::floor(turns)) * static_cast<double>(columns)));
}

}  // namespace

void SpinningScanner::add_to_columns(const Solid& solid) {
  constexpr auto kCount = static_cast<std::ptrdiff_t>(kColumns);
  const double dx = solid.at.x - frame_.origin.x;
  const double dy = solid.at.y - frame_.origin.y;
  const double distance = std::sqrt(dx * dx + dy * dy);
  const double reach =
      solid.form == Solid::Form::kCylinder
          ? solid.half_length
          : std::sqrt(solid.half_length * solid.half_length + solid.half_width * solid.half_width);
  const Candidate candidate{std::max(0.0, distance - reach), &solid};
  if (candidate.nearest > kFarthest) {
    return;
  }
  std::ptrdiff_t first = 0;
  std::ptrdiff_t count = kCount;
  if (distance > reach) {
    const double half = std::asin(reach / distance);
    const double middle = std::atan2(dy, dx);
    first = column_of(middle - half, kColumns) - 1;
    const auto wide = static_cast<std::ptrdiff_t>(half / std::numbers::pi * kCount);
    count = std::min(kCount, wide + 4);
  }
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    columns_[static_cast<std::size_t>((first + i + kCount) % kCount)].push_back(candidate);
  }
}

void SpinningScanner::move_to(const EgoPose& ego, std::span<const Solid> solids) {
  frame_ = placed(mount_, ego);
  for (std::vector<Candidate>& column : columns_) {
    column.clear();
  }
  for (const Solid& solid : solids) {
    add_to_columns(solid);
  }
  for (std::vector<Candidate>& column : columns_) {
    std::ranges::stable_sort(column, {}, &Candidate::nearest);
  }
}

// A beam is never shorter than its plan, so what is nearer in the plan may be met first.
std::optional<double> SpinningScanner::measure(const Vector3& along, double height_m,
                                               Random& random) const {
  const Vector3& up = frame_.up;
  const Ray ray{{frame_.origin.x + height_m * up.x, frame_.origin.y + height_m * up.y,
                 frame_.origin.z + height_m * up.z},
                frame_.direction(along)};
  double distance = kNoHit;
  Material material = Material::kGround;
  if (ray.along.z < 0) {
    distance = ray.from.z / -ray.along.z;
  }
  const std::ptrdiff_t column = column_of(std::atan2(ray.along.y, ray.along.x), kColumns);
  for (const Candidate& candidate : columns_[static_cast<std::size_t>(column) % kColumns]) {
    if (candidate.nearest > distance) {
      break;
    }
    const double to_it = distance_to(*candidate.solid, ray);
    if (to_it > 0 && to_it < distance) {
      distance = to_it;
      material = candidate.solid->material;
    }
  }
  if (distance > kFarthest || !comes_back(material, distance, 1, random)) {
    return std::nullopt;
  }
  return std::max(0.0, distance + sigma_m_ * random.bell());
}

}  // namespace iog::tools
