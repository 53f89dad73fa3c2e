// What a ray meets, by the structure that a scanner sorts a scene into, is what it meets by asking
// every solid.
#include "tools/simulate/scanners/ray_caster.hpp"

#include <cmath>
#include <string_view>

#include "gtest/gtest.h"

#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"

namespace iog::tools {
namespace {

constexpr double kFarthest = 200;

// The nearest of all that is there at that share of the interval.
double nearest_of_all(const std::vector<MovingSolid>& solids, const Ray& ray, double share,
                      double beyond) {
  double nearest = ray.along.z < 0 ? ray.from.z / -ray.along.z : kNoHit;
  for (const MovingSolid& solid : solids) {
    const double distance = distance_to(solid.at(share), ray);
    if (distance > beyond && distance < nearest) {
      nearest = distance;
    }
  }
  return nearest;
}

// A beam from somewhere on the scanner, mostly along the ground, some steeply up or down.
Ray some_ray(const SensorFrame& frame, Random& random) {
  const double azimuth = random.between(-3.2, 3.2);
  const double elevation =
      random.chance(0.8) ? random.between(-0.05, 0.05) : random.between(-1.5, 1.5);
  const double arm = random.between(-RayCaster::kArm, RayCaster::kArm);
  return {{frame.origin.x, frame.origin.y + arm, frame.origin.z},
          {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
           std::sin(elevation)}};
}

class RaysInto : public testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(Scenes, RaysInto, testing::Values("city", "ring_road", "street"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST_P(RaysInto, MeetWhatIsNearestAtTheirTime) {
  const Scene scene = find_scene(GetParam()).make(3, 12);
  const SensorFrame mount = frame_of({.x_m = 2, .y_m = 0.5, .z_m = 1.2, .yaw_deg = 40});
  Random random(8);
  std::size_t met = 0;
  for (const double length_s : {0.0, 0.011, 0.02}) {
    for (double from_s = 0.5; from_s < 11; from_s += 1.5) {
      const RayCaster rays(scene, mount, from_s, from_s + length_s, kFarthest);
      const std::vector<MovingSolid> solids = scene.solids_between(from_s, from_s + length_s);
      for (int i = 0; i < 400; ++i) {
        const double share = random.unit();
        const double time_s = from_s + share * length_s;
        const Ray ray = some_ray(rays.frame_at(time_s), random);
        const double beyond = random.chance(0.2) ? random.between(0, 30) : 0;
        const double expected = nearest_of_all(solids, ray, length_s > 0 ? share : 0, beyond);
        const Hit hit = rays.nearest(ray, time_s, beyond);
        if (expected > kFarthest) {
          EXPECT_GT(hit.distance, kFarthest);
        } else {
          EXPECT_NEAR(hit.distance, expected, 1e-9);
        }
        met += hit.distance < 50 ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(met, 3000U);
}

// A scanner that stands still sees the same whatever time it is asked about.
TEST(RayCaster, AWorldThatStandsStillHasNoTime) {
  const Scene scene = find_scene("city").make(1, 5);
  const RayCaster rays(scene, frame_of({.x_m = 2, .z_m = 0.5}), 3, 3, kFarthest);
  const Ray ray{rays.frame_at(3).origin, rays.frame_at(3).forward};
  EXPECT_EQ(rays.frame_at(4).origin.x, rays.frame_at(3).origin.x);
  EXPECT_EQ(rays.nearest(ray, 4).distance, rays.nearest(ray, 3).distance);
}

}  // namespace
}  // namespace iog::tools
