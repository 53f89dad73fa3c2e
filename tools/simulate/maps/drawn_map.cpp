#include "tools/simulate/maps/drawn_map.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

#include "numeric/elementary.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/truth/true_ground.hpp"

namespace iog::tools {
namespace {

enum Stream : std::uint64_t { kNoise = 20, kMissing, kOutdated, kBeside, kOnRoad, kNoWidth };

constexpr double kGhostReach = 40.0;  // metres from the car's way

// For each of `count`, whether it is one of the share that is chosen.
std::vector<bool> chosen(std::size_t count, double share, Random random) {
  const auto wanted = static_cast<std::size_t>(numeric::round(share * static_cast<double>(count)));
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::vector<bool> is_chosen(count);
  for (std::size_t i = 0; i < wanted; ++i) {
    std::swap(order[i], order[i + random.below(count - i)]);
    is_chosen[order[i]] = true;
  }
  return is_chosen;
}

void draw_roads(const SitePlan& plan, DrawnMap& map) {
  const std::vector<bool> is_bare =
      chosen(plan.roads.size(), map.errors.no_width, Random(map.seed, kNoWidth));
  for (std::size_t i = 0; i < plan.roads.size(); ++i) {
    map.roads.push_back({plan.roads[i], !is_bare[i]});
  }
}

void draw_houses(const SitePlan& plan, DrawnMap& map) {
  const std::vector<bool> is_missing =
      chosen(plan.houses.size(), map.errors.missing, Random(map.seed, kMissing));
  Random noise(map.seed, kNoise);
  for (std::size_t i = 0; i < plan.houses.size(); ++i) {
    PlannedHouse house = plan.houses[i];
    house.at.x += map.errors.noise_m * noise.bell();
    house.at.y += map.errors.noise_m * noise.bell();
    if (is_missing[i]) {
      map.missing.push_back(plan.houses[i]);
    } else {
      map.houses.push_back({house});
    }
  }
}

void rebuild(DrawnHouse& drawn, Random& random) {
  drawn.how = HouseDrawn::kOutdated;
  drawn.house.half_length_m *= random.between(0.6, 1.4);
  drawn.house.half_width_m *= random.between(0.6, 1.4);
  drawn.house.at.x += random.between(-2, 2);
  drawn.house.at.y += random.between(-2, 2);
}

void draw_outdated(DrawnMap& map) {
  Random random(map.seed, kOutdated);
  const std::vector<bool> is_old = chosen(map.houses.size(), map.errors.outdated, random);
  for (std::size_t i = 0; i < map.houses.size(); ++i) {
    if (is_old[i]) {
      rebuild(map.houses[i], random);
    }
  }
}

PlannedHouse some_house(const Placement& at, Random& random) {
  const double half_length = random.between(3, 6);
  return {.at = at, .half_length_m = half_length, .half_width_m = random.between(2, 4)};
}

// Whether nothing is planned where the house and half a metre around it would be.
bool is_free_for(const PlannedHouse& house, const TrueGround& ground) {
  constexpr double kStep = 0.5;
  for (const double x :
       stations(-house.half_length_m - kStep, house.half_length_m + 2 * kStep, kStep)) {
    for (const double y :
         stations(-house.half_width_m - kStep, house.half_width_m + 2 * kStep, kStep)) {
      const Placement at = moved(house.at, x, y);
      if (ground.at(at.x, at.y) != Ground::kBeside) {
        return false;
      }
    }
  }
  return true;
}

class Ghosts {
 public:
  Ghosts(const Scene& scene, std::uint64_t seed, double drive_s)
      : scene_(&scene),
        drive_s_(drive_s),
        ground_(scene.plan),
        beside_(seed, kBeside),
        on_road_(seed, kOnRoad) {
    for (const PlannedRoad& road : scene.plan.roads) {
      std::ranges::copy_if(road.line, std::back_inserter(near_roads_),
                           [&](const Placement& at) { return is_near_way(at); });
    }
  }

  DrawnHouse beside() {
    constexpr int kTries = 10'000;
    for (int i = 0; i < kTries; ++i) {
      const Placement car = scene_->ego_at(beside_.between(0, drive_s_)).at;
      const double forward = beside_.between(-kGhostReach, kGhostReach);
      const double left = beside_.between(-kGhostReach, kGhostReach);
      const double turn = beside_.between(0, 2 * numeric::kPi);
      const Placement at =
          turned_by(moved(car, forward, left), numeric::cos(turn), numeric::sin(turn));
      const PlannedHouse house = some_house(at, beside_);
      if (is_near_way(at) && is_free_for(house, ground_)) {
        return {house, HouseDrawn::kGhostBeside};
      }
    }
    throw UsageError("no free ground beside the road for another house that does not exist");
  }

  DrawnHouse on_road() {
    const Placement at = near_roads_[on_road_.below(near_roads_.size())];
    return {some_house(at, on_road_), HouseDrawn::kGhostOnRoad};
  }

 private:
  [[nodiscard]] bool is_near_way(const Placement& at) const {
    constexpr double kPause = 0.5;  // seconds
    for (const double time_s : stations(0, drive_s_ + kPause, kPause)) {
      const Placement car = scene_->ego_at(time_s).at;
      const double x = at.x - car.x;
      const double y = at.y - car.y;
      if (x * x + y * y < kGhostReach * kGhostReach) {
        return true;
      }
    }
    return false;
  }

  const Scene* scene_;
  double drive_s_;
  TrueGround ground_;
  Random beside_;
  Random on_road_;
  std::vector<Placement> near_roads_;
};

}  // namespace

DrawnMap drawn_map(const Scene& scene, const MapErrors& errors, std::uint64_t seed,
                   double drive_s) {
  DrawnMap map{.errors = errors, .seed = seed, .roads = {}, .houses = {}, .missing = {}};
  draw_roads(scene.plan, map);
  draw_houses(scene.plan, map);
  draw_outdated(map);
  if (errors.ghosts > 0) {
    Ghosts ghosts(scene, seed, drive_s);
    for (std::uint32_t i = 0; i < errors.ghosts; ++i) {
      map.houses.push_back(i % 2 == 0 ? ghosts.beside() : ghosts.on_road());
    }
  }
  return map;
}

}  // namespace iog::tools
