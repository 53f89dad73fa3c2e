// Ranges. Grid coordinates stay below 2^21 subcells (the grid is 2^20 wide, a line at most 2^20
// long), lengths below 2^18 mm, so every product of the two below fits 64 bits with room.

#include "vehicle/beam.hpp"

#include <algorithm>

#include "geometry/sizes.hpp"

namespace iog::vehicle {
namespace {

// The end of a beam along one axis, rounded to the nearest subcell, a tie towards plus infinity.
std::int32_t end_of(const EndCoordinate& axis, Direction direction) {
  constexpr int kFractionBits = kAxisFractionBits + numeric::kSineFractionBits;
  const std::int64_t end = axis.base * (std::int64_t{1} << numeric::kSineFractionBits) +
                           std::int64_t{axis.forward} * direction.cosine +
                           std::int64_t{axis.left} * direction.sine;
  return static_cast<std::int32_t>((end + (std::int64_t{1} << (kFractionBits - 1))) >>
                                   kFractionBits);
}

// Is low <= start + (end - start) * range / length <= high ? Exact.
bool lies_between(std::int32_t low, std::int32_t start, std::int64_t extent, std::uint32_t range_mm,
                  std::uint32_t length_mm, std::int32_t high) {
  const std::int64_t length = length_mm;
  const std::int64_t at = start * length + extent * std::int64_t{range_mm};
  return low * length <= at && at <= high * length;
}

std::int32_t extent(const traversal::Axis<geometry::kResolution>& axis) {
  return axis.step() * static_cast<std::int32_t>(axis.length());
}

bool is_on_the_car(const Sensor& sensor, const BeamLine& line, std::uint32_t range_mm) {
  return sensor.on_car_x.contain(extent(line.x()), range_mm) &&
         sensor.on_car_y.contain(extent(line.y()), range_mm);
}

bool is_in_band(const Vehicle& vehicle, const Sensor& sensor, const Beam& beam,
                std::uint32_t range_mm) {
  return lies_between(vehicle.z_min, sensor.origin_z, std::int64_t{beam.end_z} - sensor.origin_z,
                      range_mm, sensor.range.mm(), vehicle.z_max);
}

}  // namespace

Direction direction_of(const Sensor& sensor, std::uint16_t azimuth_ticks) {
  return {.cosine = sensor.sines.cosine(azimuth_ticks), .sine = sensor.sines.sine(azimuth_ticks)};
}

BeamLine line_of(const Sensor& sensor, const Layer& layer, Direction direction) {
  return {sensor.origin, {end_of(layer.x, direction), end_of(layer.y, direction)}};
}

std::int32_t end_height_of(const Layer& layer, Direction direction) {
  return end_of(layer.z, direction);
}

Beam aim(const Sensor& sensor, std::uint8_t layer, std::uint16_t azimuth_ticks) {
  const Direction direction = direction_of(sensor, azimuth_ticks);
  const Layer& axes = sensor.layers[layer];
  return {line_of(sensor, axes, direction), end_height_of(axes, direction)};
}

Classification classify(const Sensor& sensor, const BeamLine& line, std::int32_t end_z,
                        const lidar::ScanPoint& point) {
  const bool is_first = point.echo == 0;
  if (point.range_mm == 0) {
    return {Fate::kNoReturn, is_first && sensor.no_return_clears_mm > 0, false};
  }
  if (point.is_dirt || point.is_rain) {
    return {Fate::kFlagged, false, false};
  }
  if (point.range_mm < sensor.range_min_mm || is_on_the_car(sensor, line, point.range_mm)) {
    return {Fate::kTooNear, false, false};
  }
  // A beam is straight: with both ends in the band all of it is.
  const std::uint32_t reach_mm = std::min(point.range_mm, sensor.range.mm());
  const bool ends_in_band = sensor.in_band.contain(end_z - sensor.origin_z, reach_mm);
  const bool is_whole = ends_in_band && sensor.in_band.contain(0, 0);
  if (point.is_ground) {
    return {Fate::kFlagged, is_first, false, is_whole};
  }
  if (point.range_mm > sensor.range.mm()) {
    return {Fate::kTooFar, is_first, false, is_whole};
  }
  if (!ends_in_band) {
    return {Fate::kOutsideHeightBand, is_first, false};
  }
  return is_first ? Classification{Fate::kUsed, true, true, is_whole}
                  : Classification{Fate::kLaterEcho, false, true};
}

BandPart part_in_band(const Vehicle& vehicle, const Sensor& sensor, const Beam& beam,
                      std::uint32_t reach_mm) {
  const bool starts_inside = vehicle.z_min <= sensor.origin_z && sensor.origin_z <= vehicle.z_max;
  // A line is straight: with both ends inside all of it is.
  if (starts_inside && is_in_band(vehicle, sensor, beam, reach_mm)) {
    return {};
  }
  const std::int64_t rise = std::int64_t{beam.end_z} - sensor.origin_z;
  if (rise == 0) {
    return {.is_whole = starts_inside, .is_empty = !starts_inside, .from = {}, .to = {}};
  }
  // Measured along the beam's own way up or down, the band lies from `enter` to `leave`.
  const std::int64_t enter = rise > 0 ? std::int64_t{vehicle.z_min} - sensor.origin_z
                                      : std::int64_t{sensor.origin_z} - vehicle.z_max;
  const std::int64_t leave = rise > 0 ? std::int64_t{vehicle.z_max} - sensor.origin_z
                                      : std::int64_t{sensor.origin_z} - vehicle.z_min;
  const auto extent = static_cast<std::uint64_t>(rise > 0 ? rise : -rise);
  if (leave <= 0 || enter >= static_cast<std::int64_t>(extent)) {
    return {.is_whole = false, .is_empty = true, .from = {}, .to = {}};
  }
  const auto first = static_cast<std::uint64_t>(enter > 0 ? enter : 0);
  const auto last =
      static_cast<std::uint64_t>(leave) < extent ? static_cast<std::uint64_t>(leave) : extent;
  return {.is_whole = false, .is_empty = false, .from = {first, extent}, .to = {last, extent}};
}

}  // namespace iog::vehicle
