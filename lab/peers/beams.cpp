#include "lab/peers/beams.hpp"

#include <algorithm>
#include <utility>

#include "lab/evidence/frame_points.hpp"
#include "require/require.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

PointMetres in_metres(double x_subcells, double y_subcells) {
  return {x_subcells / geometry::kSubcellsPerMetre - kHalfSideM,
          y_subcells / geometry::kSubcellsPerMetre - kHalfSideM};
}

// At this share of the beam's line, which may be above 1.
PointMetres point_at(double share, const vehicle::Sensor& sensor, const vehicle::BeamLine& line) {
  return in_metres(sensor.origin.x + share * line.x().step() * line.x().length(),
                   sensor.origin.y + share * line.y().step() * line.y().length());
}

void append(const SensorPoint& seen, PeerFrame& frame, PeerFrames& result) {
  const vehicle::Vehicle& car = *result.vehicle;
  const vehicle::Sensor& sensor = car.sensors[seen.sensor];
  const vehicle::Beam beam = vehicle::aim(sensor, seen.point.layer, seen.point.azimuth_ticks);
  const vehicle::Classification classification = vehicle::classify(sensor, beam, seen.point);
  if (!classification.evidence.carves()) {
    result.later_echoes += classification.evidence.marks() ? 1U : 0U;
    return;
  }
  require(seen.point.range_mm > 0);  // no scanner of this car clears without an echo
  const std::uint32_t reach_mm = std::min(seen.point.range_mm, sensor.range.mm());
  const vehicle::BandPart part = vehicle::part_in_band(car.band(), sensor, beam.end_z, reach_mm);
  require(!part.is_empty && part.from.numerator == 0);  // its scanners are inside the height band
  double share = static_cast<double>(seen.point.range_mm) / sensor.range.mm();
  if (!part.is_whole) {
    const auto leaves = static_cast<double>(part.to.numerator);
    share = std::min(share, leaves / static_cast<double>(part.to.denominator));
  }
  const bool is_too_far = classification.fate == vehicle::Fate::kTooFar && part.is_whole;
  frame.push_back({.sensor = seen.sensor,
                   .point = seen.point,
                   .origin = in_metres(sensor.origin.x, sensor.origin.y),
                   .end = point_at(share, sensor, beam.line),
                   .is_too_far = is_too_far,
                   .marks = classification.evidence.marks()});
  ++result.beams;
  result.only_carving += is_too_far || classification.evidence.marks() ? 0U : 1U;
}

}  // namespace

PeerFrames frames_of(const tools::CatalogueEntry& car, std::string_view scene, std::uint64_t seed,
                     std::uint32_t seconds, std::uint32_t step) {
  tools::Drive drive(car, seed, seconds, tools::find_scene(scene));
  PeerFrames result{.vehicle = car.vehicle, .frames = {}};
  for (std::uint32_t number = 0; number < drive.frame_count(); number += step) {
    PeerFrame frame;
    for (const SensorPoint& point : points_of(drive, number, car)) {
      append(point, frame, result);
    }
    result.frames.push_back(std::move(frame));
  }
  return result;
}

}  // namespace iog::lab
