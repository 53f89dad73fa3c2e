#include "tools/simulate/scanners/spinning_beams.hpp"

#include <algorithm>
#include <type_traits>

#include "lidar/formats.hpp"
#include "numeric/elementary.hpp"
#include "tools/simulate/scanners/echo_model.hpp"

namespace iog::tools {
namespace {

// Beams that fire within this time are taken to start together: the car moves by half a millimetre.
constexpr std::uint64_t kTogetherNs = 50'000;

double radians_of_beam(double degrees) { return degrees * numeric::kPi / 180; }

}  // namespace

SpinningBeams::SpinningBeams(const description::SensorConfig& config) : sigma_m_(config.sigma_m) {
  std::vector<lidar::Laser> lasers(config.lasers.begin(), config.lasers.end());
  lidar::with_decoder(config.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    for (std::size_t i = lasers.size(); i < Decoder::kElevationsDeg.size(); ++i) {
      lasers.push_back({.elevation_deg = Decoder::kElevationsDeg.at(i)});
    }
  });
  const std::int32_t turn = lidar::ticks_per_turn(config.format);
  for (const lidar::Laser& laser : lasers) {
    const double elevation = radians_of_beam(laser.elevation_deg);
    const double cosine = numeric::cos(elevation);
    const double sine = numeric::sin(elevation);
    lasers_.push_back({.cosine = cosine,
                       .sine = sine,
                       .height_m = laser.height_m / cosine,
                       .range_m = laser.height_m * sine / cosine - laser.range_m,
                       .right_ticks = -static_cast<std::int32_t>(
                           numeric::round(laser.azimuth_deg * turn / 360))});
  }
  for (std::int32_t ticks = 0; ticks < turn; ++ticks) {
    azimuth_sines_.push_back(numeric::sin(2 * numeric::kPi * ticks / turn));
  }
}

// A beam starts over the unit's origin, along its up axis.
Measured SpinningBeams::measure(std::size_t layer, std::int32_t right_ticks, std::uint64_t fires_ns,
                                const RayCaster& rays, Random& random) const {
  const Laser& laser = lasers_[layer];
  const std::size_t turn = azimuth_sines_.size();
  const std::int32_t ticks = right_ticks + laser.right_ticks + 2 * static_cast<std::int32_t>(turn);
  const auto right = static_cast<std::size_t>(ticks);
  const double sine = azimuth_sines_[right % turn];
  const double cosine = azimuth_sines_[(right + turn / 4) % turn];
  const auto together_ns = fires_ns - fires_ns % kTogetherNs;
  const double time_s = static_cast<double>(together_ns) / 1e9;
  const SensorFrame frame = rays.frame_at(time_s);
  const Ray ray{
      {frame.origin.x + laser.height_m * frame.up.x, frame.origin.y + laser.height_m * frame.up.y,
       frame.origin.z + laser.height_m * frame.up.z},
      frame.direction({laser.cosine * cosine, -laser.cosine * sine, laser.sine})};
  const Hit hit = rays.nearest(ray, time_s);
  if (hit.distance > kSpinningFarthest || !comes_back(hit.material, hit.distance, 1, random)) {
    return {};
  }
  const double way_m = std::max(0.0, hit.distance + sigma_m_ * random.bell());
  return {way_m + laser.range_m, rays.truth_of(ray, hit)};
}

}  // namespace iog::tools
