#include "lab/evaluation/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "description/mount.hpp"
#include "grid/frame_fusion.hpp"
#include "lab/reference/traversal.hpp"
#include "lidar/ibeo_lux.hpp"
#include "numeric/elementary.hpp"
#include "tools/simulate/truth/true_occupancy.hpp"

namespace iog::lab {
namespace {

constexpr int kTicksPerBeam = 2;  // a tick is 1/32 of a degree
constexpr double kCellM = geometry::kCellMm / 1000.0;
// A face on a border of cells belongs to the solid's cell: a beam ends this far inside.
constexpr double kInsideM = 1e-6;

tools::Vector3 point_on(const tools::Ray& ray, double distance) {
  return {ray.from.x + ray.along.x * distance, ray.from.y + ray.along.y * distance,
          ray.from.z + ray.along.z * distance};
}

// A part of a ray between two distances.
struct Part {
  double from = 0;
  double to = 0;
};

// The part of a ray, from its start to `reach`, between two heights.
Part part_between(const tools::Ray& ray, double low, double high, double reach) {
  Part part{0, reach};
  if (ray.along.z == 0) {
    return ray.from.z >= low && ray.from.z <= high ? part : Part{};
  }
  const double at_low = (low - ray.from.z) / ray.along.z;
  const double at_high = (high - ray.from.z) / ray.along.z;
  part.from = std::max(part.from, std::min(at_low, at_high));
  part.to = std::min(part.to, std::max(at_low, at_high));
  return part;
}

class Sight {
 public:
  Sight(const tools::CatalogueEntry& car, const tools::EgoPose& ego,
        std::span<const tools::Solid> solids)
      : band_low_(car.description->z_min_m),
        band_high_(car.description->z_max_m),
        ego_(&ego),
        solids_(solids),
        crossed_(geometry::kCellCount),
        ended_(geometry::kCellCount) {}

  void look(const description::SensorConfig& sensor) {
    const auto turn = description::rotation_of(sensor.mount);
    const double range_m = sensor.range_max_mm / 1000.0;
    const tools::Vector3 origin = pitched({sensor.mount.x_m, sensor.mount.y_m, sensor.mount.z_m});
    gather_near(origin, range_m);
    const int edge = sensor.scan_width_ticks / 2;
    for (const double elevation_deg : lidar::IbeoLux::kElevationsDeg) {
      const double elevation = description::radians(elevation_deg);
      for (int ticks = -edge; ticks <= edge; ticks += kTicksPerBeam) {
        const double azimuth = ticks * 2 * numeric::kPi / lidar::IbeoLux::kTicksPerTurn;
        const double forward = numeric::cos(elevation) * numeric::cos(azimuth);
        const double left = numeric::cos(elevation) * numeric::sin(azimuth);
        const double up = numeric::sin(elevation);
        const auto along = [&](std::size_t axis) {
          return turn.forward[axis] * forward + turn.left[axis] * left + turn.up[axis] * up;
        };
        follow({origin, pitched({along(0), along(1), along(2)})}, range_m);
      }
    }
  }

  [[nodiscard]] std::vector<CellState> states(const std::vector<bool>& occupied) const {
    std::vector<CellState> states(geometry::kCellCount, CellState::kUnknown);
    for (std::size_t cell = 0; cell < states.size(); ++cell) {
      if (ended_[cell]) {
        states[cell] = CellState::kOccupied;
      } else if (crossed_[cell] && !occupied[cell]) {
        states[cell] = CellState::kFree;
      }
    }
    return states;
  }

 private:
  struct Candidate {
    double nearest;  // no point of it is nearer
    const tools::Solid* solid;
  };

  // From the car's own frame to the level one above it, in which the grid lies.
  [[nodiscard]] tools::Vector3 pitched(const tools::Vector3& v) const {
    return {v.x * ego_->pitch_cos + v.z * ego_->pitch_sin, v.y,
            v.z * ego_->pitch_cos - v.x * ego_->pitch_sin};
  }

  [[nodiscard]] tools::Vector3 turned(const tools::Vector3& v) const {
    const tools::Placement& at = ego_->at;
    return {v.x * at.cos - v.y * at.sin, v.x * at.sin + v.y * at.cos, v.z};
  }

  // From the level frame to the world, where the solids are.
  [[nodiscard]] tools::Ray in_world(const tools::Ray& ray) const {
    tools::Vector3 from = turned(ray.from);
    from.x += ego_->at.x;
    from.y += ego_->at.y;
    return {from, turned(ray.along)};
  }

  void gather_near(const tools::Vector3& origin, double range_m) {
    near_.clear();
    const tools::Vector3 from = in_world({origin, {}}).from;
    for (const tools::Solid& solid : solids_) {
      const double dx = solid.at.x - from.x;
      const double dy = solid.at.y - from.y;
      const double reach =
          std::sqrt(solid.half_length * solid.half_length + solid.half_width * solid.half_width);
      const double nearest = std::sqrt(dx * dx + dy * dy) - reach;
      if (nearest <= range_m) {
        near_.push_back({nearest, &solid});
      }
    }
    std::ranges::stable_sort(near_, {}, &Candidate::nearest);
  }

  [[nodiscard]] double nearest_solid(const tools::Ray& ray, double range_m) const {
    const tools::Ray world_ray = in_world(ray);
    double nearest = tools::kNoHit;
    for (const Candidate& candidate : near_) {
      if (candidate.nearest > std::min(nearest, range_m)) {
        break;
      }
      nearest = std::min(nearest, tools::distance_to(*candidate.solid, world_ray));
    }
    return nearest;
  }

  void follow(const tools::Ray& ray, double range_m) {
    const double ground = ray.along.z < 0 ? ray.from.z / -ray.along.z : tools::kNoHit;
    const double solid = nearest_solid(ray, std::min(ground, range_m));
    const double reach = std::min({ground, solid, range_m});
    const Part part = part_between(ray, band_low_, band_high_, reach);
    if (part.from > part.to || part.to <= 0) {
      return;
    }
    cross(point_on(ray, part.from), point_on(ray, part.to));
    // The part is cut short if the band ends before the solid.
    if (solid == reach && part.to == reach) {
      end_in(point_on(ray, reach + kInsideM));
    }
  }

  static double cells(double metres) { return metres / kCellM + geometry::kOriginCell; }

  void cross(const tools::Vector3& from, const tools::Vector3& to) {
    reference::walk_amanatides_woo<double>({cells(from.x), cells(from.y)},
                                           {cells(to.x), cells(to.y)},
                                           [this](geometry::Cell cell) { set(crossed_, cell); });
  }

  void end_in(const tools::Vector3& point) {
    set(ended_, {static_cast<std::int32_t>(std::floor(cells(point.x))),
                 static_cast<std::int32_t>(std::floor(cells(point.y)))});
  }

  static void set(std::vector<std::uint8_t>& flags, geometry::Cell cell) {
    if (geometry::kGridArea.contains(cell)) {
      flags[static_cast<std::size_t>(cell.y) * geometry::kCellsPerSide +
            static_cast<std::size_t>(cell.x)] = 1;
    }
  }

  double band_low_;
  double band_high_;
  const tools::EgoPose* ego_;
  std::span<const tools::Solid> solids_;
  std::vector<Candidate> near_;
  std::vector<std::uint8_t> crossed_;
  std::vector<std::uint8_t> ended_;
};

}  // namespace

std::vector<CellState> visibility(const tools::CatalogueEntry& car, const tools::EgoPose& ego,
                                  std::span<const tools::Solid> solids) {
  Sight sight(car, ego, solids);
  for (const description::SensorConfig& sensor : car.sensors) {
    sight.look(sensor);
  }
  return sight.states(tools::true_occupancy(ego, solids, *car.description));
}

}  // namespace iog::lab
