#include "tools/simulate/scanners/echo_model.hpp"

#include <algorithm>

#include "numeric/elementary.hpp"

namespace iog::tools {
namespace {

constexpr double kMissed = 0.015;  // of echoes that ought to come back
constexpr double kSigma = 0.07;    // metres
constexpr double kGroundLabelledShare = 0.93;
constexpr double kRain = 0.0008;
constexpr double kDirt = 0.0003;

// Metres up to which nearly every echo comes back; at twice that none does.
double reach_of(Material material) {
  switch (material) {
    case Material::kWall:
      return 110;
    case Material::kCar:
      return 90;
    case Material::kPole:
    case Material::kRail:
    case Material::kBank:
      return 60;
    case Material::kPerson:
    case Material::kFoliage:
      return 50;
    case Material::kKerb:
    case Material::kGround:
      break;
  }
  return 25;
}

std::uint16_t centimetres(double metres) {
  return static_cast<std::uint16_t>(numeric::round(std::clamp(metres, 0.0, 655.0) * 100));
}

}  // namespace

bool comes_back(Material material, double distance, double strength, Random& random) {
  if (distance > kLuxFarthest || random.chance(kMissed)) {
    return false;
  }
  const double reach = reach_of(material) * (0.5 + 0.5 * strength);
  return distance <= reach || random.chance(2 - distance / reach);
}

void measure(Material material, double distance, double strength, Random& random, LuxPoint& point) {
  point.range_cm = centimetres(distance + kSigma * random.bell());
  // Nearer and wholly met surfaces send wider pulses; the LUX counts them in steps of 4 cm.
  const double width = 0.6 + 2.4 * strength * (1 - distance / (kLuxFarthest + 20));
  point.pulse_width_cm = static_cast<std::uint16_t>(
      numeric::round(std::max(0.2, width + 0.15 * random.bell()) * 25) * 4);
  const bool is_labelled = material == Material::kGround && random.chance(kGroundLabelledShare);
  point.flags = is_labelled ? kLuxGround : std::uint8_t{0};
}

bool add_clutter(Random& random, LuxPoint& point) {
  const double draw = random.unit();
  if (draw >= kRain + kDirt) {
    return false;
  }
  const bool is_rain = draw < kRain;
  point.range_cm = centimetres(is_rain ? random.between(1, 9) : random.between(0.1, 0.35));
  point.pulse_width_cm = 40;
  point.flags = is_rain ? kLuxRain : kLuxDirt;
  return true;
}

}  // namespace iog::tools
