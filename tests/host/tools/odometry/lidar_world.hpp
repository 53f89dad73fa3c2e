// Boxes on a plain, and a lidar of sixteen rings that drives among them on a known path.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "tools/odometry/odometry.hpp"

namespace iog::tools {

inline constexpr std::uint64_t kTurnUs = 100'000;
inline constexpr std::uint64_t kBeginUs = 1'700'000'000'000'000;
inline constexpr double kTestDegree = std::numbers::pi / 180;

// Upright, from the ground up to any height.
struct Box {
  double x_min, x_max, y_min, y_max;
};
using Boxes = std::vector<Box>;

struct TruePose {
  double x_m = 0;
  double y_m = 0;
  double heading_rad = 0;
};
using Path = std::function<TruePose(double seconds)>;

// Houses of many sizes beside a road along x.
inline Boxes street() {
  std::mt19937 random(7);
  Boxes boxes;
  for (double x = -80; x < 400; x += 9) {
    for (const double side : {-1.0, 1.0}) {
      const double depth = 8 + static_cast<double>(random() % 500) / 100;
      const double width = 3 + static_cast<double>(random() % 500) / 100;
      const double near = side > 0 ? depth : -depth - 3;
      boxes.push_back({x, x + width, near, near + 3});
    }
  }
  return boxes;
}

inline Boxes tunnel() { return {{-900, 900, 5, 6}, {-900, 900, -6, -5}}; }

// Where a ray from inside of none enters the first box, or the ground; infinity: nowhere.
inline double reach_of(const Boxes& boxes, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  double nearest = to.z() < 0 ? -from.z() / to.z() : std::numeric_limits<double>::infinity();
  for (const Box& box : boxes) {
    const double x_a = (box.x_min - from.x()) / to.x();
    const double x_b = (box.x_max - from.x()) / to.x();
    const double y_a = (box.y_min - from.y()) / to.y();
    const double y_b = (box.y_max - from.y()) / to.y();
    const double enters = std::max(std::min(x_a, x_b), std::min(y_a, y_b));
    const double leaves = std::min(std::max(x_a, x_b), std::max(y_a, y_b));
    nearest = enters > 0 && enters < leaves ? std::min(nearest, enters) : nearest;
  }
  return nearest;
}

// The turn that ends so many turns after kBeginUs. Ranges have an error of up to 3 cm.
inline Turn turn_at(const Boxes& boxes, const Path& path, std::uint64_t number) {
  std::mt19937 random(static_cast<std::uint32_t>(number));
  constexpr int kSteps = 450;
  constexpr double kHeightM = 1.8;
  Turn turn{.end_us = kBeginUs + number * kTurnUs};
  for (int step = 1; step <= kSteps; ++step) {
    const double since_end_s = (step - kSteps) * 1e-6 * kTurnUs / kSteps;
    const double seconds = 1e-6 * static_cast<double>(number * kTurnUs) + since_end_s;
    const TruePose at = path(seconds);
    const double azimuth = -step * 2 * std::numbers::pi / kSteps;
    for (int ring = -15; ring <= 15; ring += 2) {
      const double out = std::cos(ring * kTestDegree);
      const double up = std::sin(ring * kTestDegree);
      const Eigen::Vector3d ray(out * std::cos(at.heading_rad + azimuth),
                                out * std::sin(at.heading_rad + azimuth), up);
      const double range = reach_of(boxes, {at.x_m, at.y_m, kHeightM}, ray);
      const double seen = range + (static_cast<double>(random() % 61) - 30) / 1000;
      if (range < 100) {
        turn.points.push_back(
            {{seen * out * std::cos(azimuth), seen * out * std::sin(azimuth), kHeightM + seen * up},
             turn.end_us - static_cast<std::uint64_t>(-since_end_s * 1e6)});
      }
    }
  }
  return turn;
}

}  // namespace iog::tools
