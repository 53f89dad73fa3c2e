// From a scan point to its beam: the point's fate, the beam's line on the grid, and which part of
// the line counts (docs/model.md sections 5 and 6).
#pragma once

#include <cstddef>
#include <cstdint>

#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {

// What became of a scan point. Each has exactly one fate. If several would fit, the first one in
// this order of tests counts: no return, flagged dirt or rain, too near, flagged ground, too far,
// outside the height band, later echo, used. The values are on the wire (docs/spec.md).
enum class Fate : std::uint8_t {
  kUsed,               // carves and marks
  kNoReturn,           // no evidence, or carves up to the sensor's no_return_clears_mm
  kTooNear,            // below the sensor's minimum or on the car itself: dropped
  kTooFar,             // beyond the model's range: carves up to it
  kOutsideHeightBand,  // carves where the beam is inside the band
  kFlagged,            // ground: carves; dirt, rain: dropped
  kLaterEcho,          // marks
  kMalformed,          // dropped with its packet
};
inline constexpr std::size_t kFateCount = 8;

// The part of a line between two shares of its length, both counted from its start. Unless the
// whole line counts, `to` is at most 1.
struct BandPart {
  bool is_whole = true;
  bool is_empty = false;
  traversal::Share from;
  traversal::Share to;
};

// Cosine and sine of an azimuth, in units of 2^-30.
struct Direction {
  std::int32_t cosine = 0;
  std::int32_t sine = 0;
};

struct Beam {
  BeamLine line;
  std::int32_t end_z;  // height of the line's end in subcells
};

struct Classification {
  Fate fate;
  bool carves;
  bool marks;
  bool is_whole_in_band = false;  // nothing of the beam up to its point or L is outside the band
};

// azimuth_ticks < one turn.
[[nodiscard]] Direction direction_of(const Sensor& sensor, std::uint16_t azimuth_ticks);

// The line on the grid and the height of its end, in subcells, of a layer's beam in this direction.
[[nodiscard]] BeamLine line_of(const Sensor& sensor, const Layer& layer, Direction direction);
[[nodiscard]] std::int32_t end_height_of(const Layer& layer, Direction direction);

// Both together. layer < sensor.layer_count, azimuth_ticks < one turn.
[[nodiscard]] Beam aim(const Sensor& sensor, std::uint8_t layer, std::uint16_t azimuth_ticks);

// line and end_z are those of its beam.
[[nodiscard]] Classification classify(const Sensor& sensor, const BeamLine& line,
                                      std::int32_t end_z, const lidar::ScanPoint& point);
[[nodiscard]] inline Classification classify(const Sensor& sensor, const Beam& beam,
                                             const lidar::ScanPoint& point) {
  return classify(sensor, beam.line, beam.end_z, point);
}

// Which part of the beam between its origin and reach_mm <= L is inside the height band. Heights at
// the band's ends are inside.
[[nodiscard]] BandPart part_in_band(const Vehicle& vehicle, const Sensor& sensor, const Beam& beam,
                                    std::uint32_t reach_mm);

}  // namespace iog::vehicle
