// What stands in a simulated scene: boxes and cylinders with upright sides.
//
// World frame: metres, z up; flat ground is at z = 0. Only + - * / and sqrt are used, so that every
// machine computes the same distances.
#pragma once

#include <cstdint>

namespace iog::tools {

// What it is made of decides how far it is seen and what an echo of it looks like.
enum class Material : std::uint8_t {
  kGround,
  kWall,
  kCar,
  kPole,
  kKerb,
  kPerson,
  kFoliage,
  kRail,
  kBank
};

// Where something stands and which way it points.
struct Placement {
  double x = 0;
  double y = 0;
  double cos = 1;
  double sin = 0;
};

// The plane that a solid's heights are over. Where it slopes, so do floor and roof, and the sides
// stay upright.
struct Footing {
  double z = 0;      // under its centre
  double along = 0;  // slope along its heading
  double left = 0;   // slope to its left
};

// Numbers of things: a car's body and its cabin have one. Below kFirstMover are those of a
// landscape, which never move; 0 is nothing.
inline constexpr std::uint32_t kFirstMover = 1'000'000;

struct Solid {
  enum class Form : std::uint8_t { kBox, kCylinder };

  Form form = Form::kBox;
  Material material = Material::kWall;
  Placement at;            // the centre
  double half_length = 0;  // along its heading; of a cylinder: its radius
  double half_width = 0;   // of a cylinder: its radius
  double z_low = 0;        // over its footing
  double z_high = 0;
  std::uint32_t thing = 0;  // of which it is a part; 0: nobody has numbered it
  Footing footing{};        // of a cylinder without slopes
};

struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;
};

struct Ray {
  Vector3 from;
  Vector3 along;  // of length 1
};

[[nodiscard]] inline Vector3 point_at(const Ray& ray, double distance) {
  return {ray.from.x + distance * ray.along.x, ray.from.y + distance * ray.along.y,
          ray.from.z + distance * ray.along.z};
}

inline constexpr double kNoHit = 1e30;

// The distance along the ray to the solid's surface, kNoHit if it is missed or holds the start.
[[nodiscard]] double distance_to(const Solid& solid, const Ray& ray);

// Whether the point (x, y) lies in its outline.
[[nodiscard]] bool covers(const Solid& solid, double x, double y);

[[nodiscard]] Solid box(Material material, const Placement& at, double length, double width,
                        double z_low, double z_high);
[[nodiscard]] Solid cylinder(Material material, double x, double y, double radius, double z_low,
                             double z_high);

}  // namespace iog::tools
