#include "tools/simulate/scenes/town.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "tools/map/map_maker.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/town_route.hpp"
#include "tools/simulate/world/street_furniture.hpp"

namespace iog::tools {
namespace {

constexpr double kWallDepth = 0.3;
constexpr double kCarSide = 1.2;       // from the middle of a lane, with some room
constexpr double kAheadOfTheCar = 40;  // as far as the car that drives ahead
constexpr double kBehindTheCar = 60;
constexpr double kRoomAround = 40;  // stations of walls that can be near a place

// Between 3.5 and 6.5 m/s: corners of 90 degrees are taken with 3.3 m/s^2 at most.
constexpr Cruise kCruise{.mean_speed = 5.0, .speed_swing = 1.5, .swing_period = 41.0, .left = 0};
constexpr double kOncomingSpeed = 7.0;

struct Wall {
  double station;
  Road::Point from;
  Road::Point to;
  double height;
};

double distance_to(const Wall& wall, double x, double y) {
  const double along_x = wall.to.x - wall.from.x;
  const double along_y = wall.to.y - wall.from.y;
  const double square = along_x * along_x + along_y * along_y;
  const double share = ((x - wall.from.x) * along_x + (y - wall.from.y) * along_y) / square;
  const double at = std::clamp(share, 0.0, 1.0);
  const double off_x = wall.from.x + along_x * at - x;
  const double off_y = wall.from.y + along_y * at - y;
  return std::sqrt(off_x * off_x + off_y * off_y);
}

Solid solid_of(const Wall& wall) {
  const double x = wall.to.x - wall.from.x;
  const double y = wall.to.y - wall.from.y;
  const double length = std::sqrt(x * x + y * y);
  const Placement middle{.x = (wall.from.x + wall.to.x) / 2,
                         .y = (wall.from.y + wall.to.y) / 2,
                         .cos = x / length,
                         .sin = y / length};
  return box(Material::kWall, middle, length + kWallDepth, kWallDepth, 0, wall.height);
}

// The middle of the right lane of a road of that width; on a narrow one cars keep to the right.
double lane_of(double width_m) { return std::clamp(width_m / 4, 1.0, 1.75); }

class Builder {
 public:
  Builder(const GeoMap& map, const MapOrigin& origin, std::uint64_t seed, double drive_s)
      : random_(seed, 1),
        drive_s_(drive_s),
        drive_m_(kCruise.station_at(drive_s)),
        route_(town_route(map, origin, drive_m_ + kAheadOfTheCar, kBehindTheCar)),
        lane_(lane_of(route_.width_m)),
        // Whole millimetres, as poses say it.
        place_{.origin = origin,
               .local_frame =
                   wire_pose(route_.points[route_.start].x, route_.points[route_.start].y, 0)},
        road_(road_at_start()) {
    plan_samples();
    add_walls(map, origin.plane());
  }

  Town town() {
    Town town{.scene = {.road = road_, .cruise = kCruise, .landscape = {}, .traffic = {}},
              .place = place_,
              .walls = walls_.size(),
              .walls_in_the_way = in_the_way_};
    town.scene.cruise.left = -lane_;
    for (const Wall& wall : walls_) {
      place(wall.station, solid_of(wall), town.scene.landscape);
    }
    add_lamp_posts(town.scene.landscape);
    town.scene.landscape.sort();
    add_cars(town.scene.traffic);
    add_walkers(town.scene.traffic);
    return town;
  }

 private:
  static constexpr double kSample = 5;  // metres; a wall's station is that of a sample

  struct Sample {
    double station;
    Placement at;
  };

  [[nodiscard]] Road::Point in_world(double east_m, double north_m) const {
    return {east_m - place_.local_frame.x_mm / 1000.0, north_m - place_.local_frame.y_mm / 1000.0};
  }

  [[nodiscard]] Road road_at_start() const {
    std::vector<Road::Point> points;
    for (const Road::Point& point : route_.points) {
      points.push_back(in_world(point.x, point.y));
    }
    return {std::move(points), route_.start};
  }

  void plan_samples() {
    const double first = -Road::kStep * static_cast<double>(route_.start);
    const double length = Road::kStep * static_cast<double>(route_.points.size() - 1);
    for (const double station : stations(first, first + length, kSample)) {
      samples_.push_back({station, road_.at(station, 0)});
    }
  }

  void add_walls(const GeoMap& map, const LocalPlane& plane) {
    for (const GeoArea& area : map.areas) {
      if (area.kind != map::Kind::kBuilding) {
        continue;
      }
      const double height = random_.between(5, 15);
      for (const std::vector<GeoPoint>& ring : area.rings) {
        add_ring(ring, plane, height);
      }
    }
    std::ranges::stable_sort(walls_, {}, &Wall::station);
  }

  void add_ring(const std::vector<GeoPoint>& ring, const LocalPlane& plane, double height) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Road::Point from = corner(ring[i], plane);
      const Road::Point to = corner(ring[(i + 1) % ring.size()], plane);
      if (from.x != to.x || from.y != to.y) {
        add_wall({0, from, to, height});
      }
    }
  }

  [[nodiscard]] Road::Point corner(const GeoPoint& point, const LocalPlane& plane) const {
    const LocalPlane::Place place = plane.place_of(point.latitude, point.longitude);
    return in_world(place.east_m, place.north_m);
  }

  // What is out of sight is nothing, and what is in the way of cars cannot be.
  void add_wall(Wall wall) {
    const auto away = [&](const Sample& sample) {
      return distance_to(wall, sample.at.x, sample.at.y);
    };
    const auto nearest = std::ranges::min_element(samples_, {}, away);
    if (away(*nearest) > kSight) {
      return;
    }
    wall.station = nearest->station;
    if (away(*nearest) < lane_ + kCarSide + kSample && is_in_the_way(wall)) {
      ++in_the_way_;
    } else {
      walls_.push_back(wall);
    }
  }

  [[nodiscard]] bool is_in_the_way(const Wall& wall) const {
    // A long wall may cross the road far from the sample that is nearest to it.
    return std::ranges::any_of(stations(wall.station - 50, wall.station + 50, 0.5),
                               [&](double station) {
                                 const Placement at = road_.at(station, 0);
                                 return distance_to(wall, at.x, at.y) < lane_ + kCarSide;
                               });
  }

  [[nodiscard]] bool is_free(double station, double left, double room) const {
    const Placement at = road_.at(station, left);
    const auto from = std::ranges::lower_bound(walls_, station - kRoomAround, {}, &Wall::station);
    const auto to = std::ranges::upper_bound(walls_, station + kRoomAround, {}, &Wall::station);
    return std::none_of(from, to,
                        [&](const Wall& wall) { return distance_to(wall, at.x, at.y) < room; });
  }

  void place(double station, const Solid& solid, Landscape& landscape) {
    fresh_.push_back(solid);
    landscape.place(station, fresh_);
  }

  void add_lamp_posts(Landscape& landscape) {
    double side = 1;
    for (const double station : stations(-kSight, drive_m_ + kSight, 27)) {
      const double left = side * (route_.width_m / 2 + 0.5);
      if (is_free(station, left, 0.3)) {
        const Placement at = road_.at(station, left);
        place(station, cylinder(Material::kPole, at.x, at.y, 0.08, 0, 6), landscape);
      }
      side = -side;
    }
  }

  // One ahead, and those that come the other way if the road is wide enough for two.
  void add_cars(Traffic& traffic) {
    traffic.companions.push_back(
        {.ahead = 24, .swing = 7, .swing_period = 23, .left = -lane_, .shape = some_car(random_)});
    if (route_.width_m < 4 * kCarSide) {
      return;
    }
    double station = 30;
    while (station < drive_m_ + kSight + kOncomingSpeed * drive_s_) {
      traffic.cars.push_back({.station = station,
                              .left = lane_,
                              .speed = -kOncomingSpeed,
                              .shape = some_car(random_)});
      station += random_.between(40, 120);
    }
  }

  // Beside the carriageway, wherever no wall is in their way.
  void add_walkers(Traffic& traffic) {
    double station = -kSight;
    while (station < drive_m_ + kSight) {
      const double side = random_.chance(0.5) ? 1 : -1;
      const double pace = random_.between(0.9, 1.6) * (random_.chance(0.5) ? 1 : -1);
      const double left = side * (route_.width_m / 2 + random_.between(0.8, 1.4));
      if (can_walk(station, station + pace * drive_s_, left)) {
        traffic.walkers.push_back({.station = station, .left = left, .speed = pace});
      }
      station += random_.between(8, 24);
    }
  }

  [[nodiscard]] bool can_walk(double from, double to, double left) const {
    return std::ranges::all_of(stations(std::min(from, to), std::max(from, to) + 0.5, 0.5),
                               [&](double station) { return is_free(station, left, 0.5); });
  }

  Random random_;
  double drive_s_;
  double drive_m_;
  TownRoute route_;
  double lane_;
  MapPlace place_;
  Road road_;
  std::vector<Sample> samples_;
  std::vector<Wall> walls_;  // by station
  std::size_t in_the_way_ = 0;
  std::vector<Solid> fresh_;
};

}  // namespace

Town make_town(const GeoMap& map, const std::optional<MapOrigin>& origin, std::uint64_t seed,
               double drive_s) {
  return Builder(map, origin ? *origin : middle_of(map), seed, drive_s).town();
}

std::string summary_of(const Town& town) {
  std::ostringstream text;
  text << town.walls << " walls of houses, " << town.walls_in_the_way
       << " left out because cars would drive through them; plane at "
       << text_of(town.place.origin);
  return text.str();
}

}  // namespace iog::tools
