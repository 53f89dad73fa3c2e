#include "tools/simulate/world/solid.hpp"

#include <algorithm>
#include <cmath>

namespace iog::tools {
namespace {

// The part of a ray, as distances along it, that lies between two parallel planes.
struct Stretch {
  double enter = -kNoHit;
  double leave = kNoHit;

  // Keeps what is also between low and high, where the ray is at `start` and moves by `step` per
  // metre.
  void clip(double start, double step, double low, double high) {
    if (step == 0) {
      if (start < low || start > high) {
        leave = -kNoHit;
      }
      return;
    }
    const double a = (low - start) / step;
    const double b = (high - start) / step;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }

  void clip_to_circle(double x, double y, double step_x, double step_y, double radius) {
    const double a = step_x * step_x + step_y * step_y;
    const double b = x * step_x + y * step_y;
    const double c = x * x + y * y - radius * radius;
    const double discriminant = b * b - a * c;
    if (discriminant <= 0 || a == 0) {
      leave = -kNoHit;
      return;
    }
    const double root = std::sqrt(discriminant);
    enter = std::max(enter, (-b - root) / a);
    leave = std::min(leave, (-b + root) / a);
  }
};

struct Local {
  double x;
  double y;
};

// A difference of world coordinates in the solid's own directions.
Local turned(const Placement& at, double dx, double dy) {
  return {dx * at.cos + dy * at.sin, dy * at.cos - dx * at.sin};
}

}  // namespace

double distance_to(const Solid& solid, const Ray& ray) {
  const double dx = ray.from.x - solid.at.x;
  const double dy = ray.from.y - solid.at.y;
  const Footing& footing = solid.footing;
  Local from{};
  Local step{};
  Stretch inside;
  if (solid.form == Solid::Form::kBox) {
    from = turned(solid.at, dx, dy);
    step = turned(solid.at, ray.along.x, ray.along.y);
    inside.clip(from.x, step.x, -solid.half_length, solid.half_length);
    inside.clip(from.y, step.y, -solid.half_width, solid.half_width);
  } else {
    inside.clip_to_circle(dx, dy, ray.along.x, ray.along.y, solid.half_length);
  }
  inside.clip(ray.from.z - footing.z - footing.along * from.x - footing.left * from.y,
              ray.along.z - footing.along * step.x - footing.left * step.y, solid.z_low,
              solid.z_high);
  return inside.enter > 0 && inside.enter < inside.leave ? inside.enter : kNoHit;
}

bool covers(const Solid& solid, double x, double y) {
  const double dx = x - solid.at.x;
  const double dy = y - solid.at.y;
  if (solid.form == Solid::Form::kCylinder) {
    return dx * dx + dy * dy <= solid.half_length * solid.half_length;
  }
  const Local local = turned(solid.at, dx, dy);
  return std::abs(local.x) <= solid.half_length && std::abs(local.y) <= solid.half_width;
}

Solid box(Material material, const Placement& at, double length, double width, double z_low,
          double z_high) {
  return {.form = Solid::Form::kBox,
          .material = material,
          .at = at,
          .half_length = length / 2,
          .half_width = width / 2,
          .z_low = z_low,
          .z_high = z_high};
}

Solid cylinder(Material material, double x, double y, double radius, double z_low, double z_high) {
  return {.form = Solid::Form::kCylinder,
          .material = material,
          .at = {.x = x, .y = y},
          .half_length = radius,
          .half_width = radius,
          .z_low = z_low,
          .z_high = z_high};
}

}  // namespace iog::tools
