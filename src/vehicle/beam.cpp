// Ranges: grid coordinates stay below 2^23 subcells, because the grid is at most 2^22 wide and a
// line at most 2^21 long. Heights stay below 2^27, even at the end of an 89-degree beam over a line
// of 2^20. Lengths stay below 2^18 mm. Every product of a length with one of these fits 64 bits
// with room to spare.

#include "vehicle/beam.hpp"

#include "geometry/sizes.hpp"
#include "numeric/divisor.hpp"

namespace iog::vehicle {
namespace {

// The end of a beam along one axis, rounded to the nearest subcell, a tie towards plus infinity.
// The base's whole subcells are added last: in units of 2^-40 subcells, 64 bits hold only 2^23 of
// them.
std::int32_t end_of(const EndCoordinate& axis, Direction direction) {
  constexpr int kFractionBits = kAxisFractionBits + numeric::kSineFractionBits;
  constexpr std::int64_t kFractionMask = (std::int64_t{1} << kAxisFractionBits) - 1;
  const std::int64_t end =
      (axis.base & kFractionMask) * (std::int64_t{1} << numeric::kSineFractionBits) +
      std::int64_t{axis.forward} * direction.cosine + std::int64_t{axis.left} * direction.sine;
  return static_cast<std::int32_t>(
      (axis.base >> kAxisFractionBits) +
      ((end + (std::int64_t{1} << (kFractionBits - 1))) >> kFractionBits));
}

// True if low <= start + (end - start) * range / length <= high. Exact.
bool lies_between(std::int32_t low, std::int32_t start, std::int64_t extent, std::uint32_t range_mm,
                  std::uint32_t length_mm, std::int32_t high) {
  const std::int64_t length = length_mm;
  const std::int64_t at = start * length + extent * std::int64_t{range_mm};
  return low * length <= at && at <= high * length;
}

std::int32_t extent(const traversal::Axis<geometry::kResolution>& axis) {
  return axis.step() * static_cast<std::int32_t>(axis.length());
}

bool is_in_band(const HeightBand& band, const Sensor& sensor, std::int32_t end_z,
                std::uint32_t range_mm) {
  return lies_between(band.low, sensor.origin_z, std::int64_t{end_z} - sensor.origin_z, range_mm,
                      sensor.range.mm(), band.high);
}

}  // namespace

Direction direction_of(const Sensor& sensor, std::uint32_t azimuth_step) {
  return {.cosine = sensor.sines.cosine(azimuth_step), .sine = sensor.sines.sine(azimuth_step)};
}

BeamLine line_of(const Sensor& sensor, const Layer& layer, Direction direction) {
  return {sensor.origin, {end_of(layer.x, direction), end_of(layer.y, direction)}};
}

std::int32_t end_height_of(const Layer& layer, Direction direction) {
  return end_of(layer.z, direction);
}

Beam aim(const Sensor& sensor, std::uint8_t layer, std::uint16_t azimuth_ticks) {
  const Direction direction = direction_of(sensor, sensor.azimuths.nearest(azimuth_ticks));
  const Layer& axes = sensor.layers[layer];
  return {line_of(sensor, axes, direction), end_height_of(axes, direction)};
}

// Called for each new beam. Most beams leave the limits before the first range or after the last
// one and need no division.
Ranges ranges_between(const RangeProducts& limits, std::int32_t extent, std::uint32_t from_mm,
                      std::uint32_t to_mm) {
  const auto size = static_cast<std::uint32_t>(extent < 0 ? -extent : extent);
  const std::int64_t low = extent < 0 ? -limits.high : limits.low;
  const std::int64_t high = extent < 0 ? -limits.low : limits.high;
  const std::int64_t at_from = std::int64_t{size} * from_mm;
  const std::int64_t at_to = std::int64_t{size} * to_mm;
  if (high < at_from || at_to < low) {
    return {};
  }
  std::uint32_t first = from_mm;
  std::uint32_t last = to_mm;
  if (at_from < low) {
    first = numeric::Divisor(size).divide(static_cast<std::uint64_t>(low - 1)) + 1;
  }
  if (high < at_to) {
    last = numeric::Divisor(size).divide(static_cast<std::uint64_t>(high));
  }
  return first <= last ? Ranges{first, last - first} : Ranges{};
}

Ranges ranges_on_car(const Sensor& sensor, const BeamLine& line) {
  const Ranges x =
      ranges_between(sensor.on_car_x, extent(line.x()), sensor.range_min_mm, lidar::kMaxRangeMm);
  if (x.first > lidar::kMaxRangeMm) {
    return {};
  }
  return ranges_between(sensor.on_car_y, extent(line.y()), x.first, x.first + x.width);
}

Ranges ranges_in_band(const Sensor& sensor, std::int32_t end_z) {
  return ranges_between(sensor.in_band, end_z - sensor.origin_z, 0, sensor.range.mm());
}

Ranges tall_ranges(const Sensor& sensor, std::int32_t end_z) {
  return ranges_between(sensor.tall, end_z - sensor.origin_z, 0, sensor.range.mm());
}

BeamRanges ranges_of(const Sensor& sensor, const Beam& beam) {
  return {.on_car = ranges_on_car(sensor, beam.line),
          .in_band = ranges_in_band(sensor, beam.end_z)};
}

BandPart part_in_band(const HeightBand& band, const Sensor& sensor, std::int32_t end_z,
                      std::uint32_t reach_mm) {
  const bool starts_inside = band.low <= sensor.origin_z && sensor.origin_z <= band.high;
  // A line is straight: if both ends are inside, all of it is.
  if (starts_inside && is_in_band(band, sensor, end_z, reach_mm)) {
    return {};
  }
  const std::int64_t rise = std::int64_t{end_z} - sensor.origin_z;
  if (rise == 0) {
    return {.is_whole = starts_inside, .is_empty = !starts_inside, .from = {}, .to = {}};
  }
  // Measured along the beam's rise or fall, the band extends from `enter` to `leave`.
  const std::int64_t enter = rise > 0 ? std::int64_t{band.low} - sensor.origin_z
                                      : std::int64_t{sensor.origin_z} - band.high;
  const std::int64_t leave = rise > 0 ? std::int64_t{band.high} - sensor.origin_z
                                      : std::int64_t{sensor.origin_z} - band.low;
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
