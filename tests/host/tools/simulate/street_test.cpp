// The street keeps its timetable, and nobody drives through anybody.
#include "tools/simulate/scenes/street.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "gtest/gtest.h"

#include "tools/formats/lux/lux_scan.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/world/script.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

TEST(Timetable, IsWhereItsCallsSayAndAsFast) {
  const std::vector<Timetable::Call> calls{{1, 10, 0}, {4, 25, 8}, {6, 40, 7}, {9, 50, 0}};
  const Timetable timetable(calls);
  constexpr double kStep = 1e-5;
  for (const Timetable::Call& call : calls) {
    EXPECT_NEAR(timetable.station_at(call.time_s), call.station, 1e-9);
    for (const double side : {-kStep, kStep}) {
      const double way = timetable.station_at(call.time_s + side) - call.station;
      EXPECT_NEAR(way / side, call.speed, 1e-3);
    }
  }
  EXPECT_EQ(timetable.station_at(0), 10);
  EXPECT_EQ(timetable.station_at(100), 50);
  EXPECT_DOUBLE_EQ(Timetable({{5, 100, -9}}).station_at(2), 127);
}

// From standing to 8 m/s in 4 s over 16 m is one acceleration: 2 m/s^2.
TEST(Timetable, EvenAccelerationComesOut) {
  const Timetable timetable({{15, 80, 0}, {19, 96, 8}});
  for (double time_s = 15; time_s <= 19; time_s += 0.1) {
    EXPECT_NEAR(timetable.station_at(time_s), 80 + (time_s - 15) * (time_s - 15), 1e-9);
  }
}

TEST(ScriptedWalker, WalksStandsAndWalks) {
  const ScriptedWalker walker{1, {{0, 0, 5}, {10, 12, 5}, {15, 12, 5}, {20, 12, -1}}};
  const Road road(Course{.swings = {{{0, 100}, {0, 100}}}}, -10, 50);
  EXPECT_NEAR(walker.at(road, 5).x, 16, 1e-9);  // the road begins at x = 0, station -10
  EXPECT_NEAR(walker.at(road, 12).x, walker.at(road, 14).x, 1e-12);
  EXPECT_NEAR(walker.at(road, 17.5).y, 2, 1e-9);
  EXPECT_NEAR(walker.at(road, 99).y, -1, 1e-12);
}

// A rectangle's or a circle's outline by its corners, and whether a line parts two of them
// (separating axes).
using Corners = std::vector<std::array<double, 2>>;

Corners corners_of(const Solid& solid) {
  Corners corners;
  if (solid.form == Solid::Form::kCylinder) {
    for (int i = 0; i < 16; ++i) {
      corners.push_back({solid.at.x + solid.half_length * std::cos(i * 0.3927),
                         solid.at.y + solid.half_length * std::sin(i * 0.3927)});
    }
    return corners;
  }
  for (const auto& [u, v] : {std::array{1, 1}, {1, -1}, {-1, -1}, {-1, 1}}) {
    const double x = u * solid.half_length;
    const double y = v * solid.half_width;
    corners.push_back({solid.at.x + x * solid.at.cos - y * solid.at.sin,
                       solid.at.y + x * solid.at.sin + y * solid.at.cos});
  }
  return corners;
}

bool is_parted(const Corners& a, const Corners& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto& from = a[i];
    const auto& to = a[(i + 1) % a.size()];
    const std::array normal{to[1] - from[1], from[0] - to[0]};
    const auto reach = [&](const Corners& corners) {
      double low = std::numeric_limits<double>::max();
      double high = -low;
      for (const auto& corner : corners) {
        const double along = corner[0] * normal[0] + corner[1] * normal[1];
        low = std::min(low, along);
        high = std::max(high, along);
      }
      return std::array{low, high};
    };
    const auto of_a = reach(a);
    const auto of_b = reach(b);
    if (of_a[1] < of_b[0] || of_b[1] < of_a[0]) {
      return true;
    }
  }
  return false;
}

bool overlap(const Solid& a, const Solid& b) {
  const auto reach = [](const Solid& solid) {
    return std::hypot(solid.half_length, solid.half_width);
  };
  if (std::hypot(a.at.x - b.at.x, a.at.y - b.at.y) > reach(a) + reach(b)) {
    return false;
  }
  const Corners of_a = corners_of(a);
  const Corners of_b = corners_of(b);
  return !is_parted(of_a, of_b) && !is_parted(of_b, of_a);
}

Solid own_car(const Scene& scene, double time_s) {
  Solid car = box(Material::kCar, scene.ego_at(time_s).at, 4.08, 1.73, 0.2, 1.5);
  car.thing = 1'999'999;
  return car;
}

std::size_t collisions(const Scene& scene, double time_s) {
  std::vector<Solid> solids{own_car(scene, time_s)};
  scene.append_seen_at(time_s, solids);
  std::size_t count = 0;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Solid& car = solids[i];
    if (car.material != Material::kCar || (car.thing < kFirstMover && i > 0)) {
      continue;
    }
    for (const Solid& other : solids) {
      const bool is_on_the_ground = other.z_low < 0.5 && other.material != Material::kKerb;
      if (is_on_the_ground && other.thing != car.thing && overlap(car, other)) {
        ADD_FAILURE() << "things " << car.thing << " and " << other.thing << " at " << time_s;
        ++count;
      }
    }
  }
  return count;
}

TEST(Street, NobodyDrivesThroughAnybody) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Scene scene = make_street(seed, 62);
    for (double time_s = 0; time_s < 62; time_s += 0.25) {
      ASSERT_EQ(collisions(scene, time_s), 0U) << "seed " << seed;
    }
  }
}

// Metres a second, from two places of the thing 20 ms apart. -1: it is not in sight.
double speed_of(const Scene& scene, std::uint32_t thing, double time_s) {
  for (const MovingSolid& solid : scene.solids_between(time_s - 0.01, time_s + 0.01)) {
    if (solid.begin.thing == thing) {
      return solid.way() / 0.02;
    }
  }
  return -1;
}

struct When {
  StreetRole role;
  double time_s;
  double speed;  // along the centre line; beside it up to 15 % more or less in a curve
};

TEST(Street, TheTimetableIsKeptInEveryAct) {
  constexpr std::array kTimes{
      When{StreetRole::kVisitor, 2.0, 0},   When{StreetRole::kVisitor, 8.0, 6.5},
      When{StreetRole::kVisitor, 15.0, 0},  When{StreetRole::kLeaver, 14.5, 0},
      When{StreetRole::kLeaver, 20.0, 8},   When{StreetRole::kOncomer, 6.0, 9},
      When{StreetRole::kDelivery, 15.5, 0}, When{StreetRole::kDelivery, 18.0, 0},
      When{StreetRole::kDelivery, 27.0, 9}, When{StreetRole::kBus, 5, 0},
      When{StreetRole::kBus, 21.5, 0},      When{StreetRole::kBus, 30.5, 8},
      When{StreetRole::kCrosser, 9, 0},     When{StreetRole::kCrosser, 15, 1.6},
      When{StreetRole::kStroller, 14, 0},   When{StreetRole::kStroller, 20, 1.2}};
  const Scene scene = make_street(4, 80);
  for (int act = 0; act < 3; ++act) {
    for (const When& when : kTimes) {
      const double speed =
          speed_of(scene, street_thing(act, when.role), act * kStreetActS + when.time_s);
      EXPECT_NEAR(speed, when.speed, 0.16 * when.speed)
          << "act " << act << " role " << static_cast<int>(when.role) << " at " << when.time_s;
    }
  }
}

// Points of a frame that lie on a thing or within 0.3 m of it, by the layers that look up: the
// others meet kerbs and the ground there.
std::size_t points_on(Drive& drive, std::uint32_t frame, std::uint32_t thing) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const double time_s = static_cast<double>(drive.frame_end_us(frame)) / 1e6;
  const Placement ego = drive.scene().ego_at(time_s).at;
  std::vector<Solid> solids;
  drive.scene().append_seen_at(time_s, solids);
  const auto found = std::ranges::find(solids, thing, &Solid::thing);
  EXPECT_NE(found, solids.end());
  found->half_length += 0.3;
  found->half_width += 0.3;
  std::size_t count = 0;
  for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
    const description::MountConfig& mount =
        car.sensors[sensor_of_port(car, datagram.destination.port)].mount;
    for (const LuxPoint& point : parse_lux_message(datagram.payload).points) {
      const double azimuth = (point.angle_ticks / 32.0 + mount.yaw_deg) * 0.017453292519943295;
      const Placement at = moved(ego, mount.x_m + point.range_cm / 100.0 * std::cos(azimuth),
                                 mount.y_m + point.range_cm / 100.0 * std::sin(azimuth));
      count += point.layer >= 2 && covers(*found, at.x, at.y) ? 1U : 0U;
    }
  }
  return count;
}

// The parked bus is seen, hidden by the lorry that stands beside it, and seen again.
TEST(Street, TheBusIsHiddenForFiveSeconds) {
  Drive drive(find_vehicle("reference_car"), 1, 25, find_scene("street"), Motion::kContinuous);
  const std::uint32_t bus = street_thing(0, StreetRole::kBus);
  const auto at_second = [&](double seconds) {
    return points_on(drive, static_cast<std::uint32_t>(seconds * 25), bus);
  };
  EXPECT_GT(at_second(11), 50U);
  EXPECT_GT(at_second(12), 50U);
  for (double hidden = 14.5; hidden < 20; hidden += 0.5) {
    EXPECT_LE(at_second(hidden), 3U) << hidden;
  }
  EXPECT_GT(at_second(22), 100U);
}

}  // namespace
}  // namespace iog::tools
