// From a scan point to its beam: the point's fate, the beam's line on the grid, and which part of
// the line counts (docs/model.md sections 5 and 6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {

// What became of a scan point. Each has exactly one fate. If several would fit, the first one in
// this order of tests counts: no return, flagged dirt or rain, too near, flagged ground, too far,
// outside the height band or the limits over the ground, later echo, used. The values are on the
// wire (docs/spec.md).
enum class Fate : std::uint8_t {
  kUsed,               // carves and marks
  kNoReturn,           // no evidence, or carves up to the sensor's no_return_clears_mm
  kTooNear,            // below the sensor's minimum or on the car itself: dropped
  kTooFar,             // beyond the model's range: carves up to it
  kOutsideHeightBand,  // carves where the beam is inside the band
  kFlagged,            // ground: carves; dirt, rain: dropped
  kLaterEcho,          // marks
  kMalformed,          // dropped with its packet, which is wrong or over budget
  kStale,              // dropped with its packet, which is a duplicate or late
  kNotTaken,           // dropped with its packet, because the target is too slow
  // Of a sensor that follows the ground, instead of kOutsideHeightBand. Each carves where the beam
  // is between the limits.
  kGround,
  kOverhang,     // high enough over the ground to drive under it
  kUnderGround,  // a mirror image, a hole or a drop
};
inline constexpr std::size_t kFateCount = 13;

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

// The ranges from one to another, mm, both included; or none.
struct Ranges {
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t width = 0;

  [[nodiscard]] constexpr bool contain(std::uint32_t range_mm) const {
    return range_mm - first <= width;
  }
  friend constexpr bool operator==(const Ranges&, const Ranges&) = default;
};

// Where a scan point of a beam lies, by its range alone: on the car by what the sensor measured, in
// the band by that along the line. A line goes through a convex part of space in one piece, so
// these ranges follow one another.
struct BeamRanges {
  Ranges on_car;   // those that the sensor's minimum allows
  Ranges in_band;  // those of at most L
};

// What a scan point says of its beam. Three bits of one word, which the compiler keeps in a
// register.
class Evidence {
 public:
  static constexpr int kBits = 3;

  constexpr Evidence() = default;
  constexpr Evidence(bool carves, bool marks, bool is_whole_in_band)
      : bits_((is_whole_in_band ? kWhole : 0) | (carves ? kCarves : 0) | (marks ? kMarks : 0)) {}
  [[nodiscard]] static constexpr Evidence of(std::uint32_t bits) {
    Evidence its;
    its.bits_ = bits;
    return its;
  }

  // Whether the beam makes cells freer, and whether its point marks.
  [[nodiscard]] constexpr bool carves() const { return (bits_ & kCarves) != 0; }
  [[nodiscard]] constexpr bool marks() const { return (bits_ & kMarks) != 0; }
  [[nodiscard]] constexpr bool is_any() const { return (bits_ & (kCarves | kMarks)) != 0; }
  // Nothing of the beam up to its point or L is outside the band.
  [[nodiscard]] constexpr bool is_whole_in_band() const { return (bits_ & kWhole) != 0; }
  // All three.
  [[nodiscard]] constexpr bool is_whole_hit() const { return bits_ == (kWhole | kCarves | kMarks); }

  [[nodiscard]] constexpr std::uint32_t bits() const { return bits_; }  // below 2^kBits

 private:
  static constexpr std::uint32_t kWhole = 1;
  static constexpr std::uint32_t kCarves = 2;
  static constexpr std::uint32_t kMarks = 4;

  std::uint32_t bits_ = 0;
};

struct Classification {
  Fate fate;
  Evidence evidence;
};

// What carves and what marks: a point that is used and a later echo mark, and of what is evidence
// all but a later echo carves, of whose beam the first echo speaks.
[[nodiscard]] constexpr Classification classified(Fate fate, bool is_evidence,
                                                  bool is_whole_in_band = false) {
  return {.fate = fate,
          .evidence = {is_evidence && fate != Fate::kLaterEcho,
                       fate == Fate::kUsed || fate == Fate::kLaterEcho, is_whole_in_band}};
}

// azimuth_step: of sensor.azimuths.
[[nodiscard]] Direction direction_of(const Sensor& sensor, std::uint32_t azimuth_step);

// The line on the grid and the height of its end, in subcells, of a layer's beam in this direction.
[[nodiscard]] BeamLine line_of(const Sensor& sensor, const Layer& layer, Direction direction);
[[nodiscard]] std::int32_t end_height_of(const Layer& layer, Direction direction);

// Both together, of the step nearest to an azimuth. layer < sensor.layer_count, azimuth_ticks < one
// turn.
[[nodiscard]] Beam aim(const Sensor& sensor, std::uint8_t layer, std::uint16_t azimuth_ticks);

// The ranges with which a point's coordinate lies between the limits of an axis along which the
// line is so long, of those from one to another. Exact.
[[nodiscard]] Ranges ranges_between(const RangeProducts& limits, std::int32_t extent,
                                    std::uint32_t from_mm, std::uint32_t to_mm);

// The parts of BeamRanges: of a line, and of the height of its end.
[[nodiscard]] Ranges ranges_on_car(const Sensor& sensor, const BeamLine& line);
[[nodiscard]] Ranges ranges_in_band(const Sensor& sensor, std::int32_t end_z);
// Those in the band that are tall by Sensor::moved.
[[nodiscard]] Ranges tall_ranges(const Sensor& sensor, std::int32_t end_z);
[[nodiscard]] BeamRanges ranges_of(const Sensor& sensor, const Beam& beam);

// Whether a return is at the height of an obstacle, which fate it has if not, and whether its beam
// is so from its start up to there.
struct Height {
  bool is_obstacle = true;
  Fate otherwise = Fate::kUsed;
  bool is_whole = false;
};

// on_car are the ranges of its beam, along_mm is the point's range along its line,
// Layer::along_line_mm(). No return and too near are judged by the range itself, all else by that:
// height_at(reach_mm) is the Height of a return that is a return, and evidence if its sensor does
// not say otherwise; reach_mm is along_mm, or L beyond it. Inline, because it is asked once for
// each point.
template <typename HeightAt>
[[nodiscard, gnu::always_inline]] constexpr Classification classify(const Sensor& sensor,
                                                                    const Ranges& on_car,
                                                                    const lidar::ScanPoint& point,
                                                                    std::uint32_t along_mm,
                                                                    HeightAt&& height_at) {
  const bool is_first = point.echo == 0;
  if (point.range_mm == 0) {
    return classified(Fate::kNoReturn, is_first && sensor.no_return_clears_mm > 0);
  }
  if (point.is_dirt || point.is_rain) {
    return classified(Fate::kFlagged, false);
  }
  if (point.range_mm < sensor.range_min_mm || on_car.contain(point.range_mm)) {
    return classified(Fate::kTooNear, false);
  }
  const bool is_too_far = along_mm > sensor.range.mm();
  const Height height = height_at(is_too_far ? sensor.range.mm() : along_mm);
  if (point.is_ground) {
    return classified(Fate::kFlagged, is_first, height.is_whole);
  }
  if (is_too_far) {
    return classified(Fate::kTooFar, is_first, height.is_whole);
  }
  if (!height.is_obstacle) {
    return classified(height.otherwise, is_first);
  }
  return classified(is_first ? Fate::kUsed : Fate::kLaterEcho, true, height.is_whole);
}

// By the vehicle's height band. A beam is straight: with both ends in the band all of it is.
[[nodiscard, gnu::always_inline]] constexpr Classification classify(const Sensor& sensor,
                                                                    const BeamRanges& ranges,
                                                                    const lidar::ScanPoint& point,
                                                                    std::uint32_t along_mm) {
  return classify(sensor, ranges.on_car, point, along_mm, [&](std::uint32_t reach_mm) {
    const bool ends_in_band = ranges.in_band.contain(reach_mm);
    return Height{.is_obstacle = ends_in_band,
                  .otherwise = Fate::kOutsideHeightBand,
                  .is_whole = ends_in_band && ranges.in_band.first == 0};
  });
}
[[nodiscard]] constexpr Classification classify(const Sensor& sensor, const BeamRanges& ranges,
                                                const lidar::ScanPoint& point) {
  return classify(sensor, ranges, point, sensor.layers[point.layer].along_line_mm(point.range_mm));
}
[[nodiscard]] inline Classification classify(const Sensor& sensor, const Beam& beam,
                                             const lidar::ScanPoint& point) {
  return classify(sensor, ranges_of(sensor, beam), point);
}

// Which part of a beam between its origin and reach_mm <= L is inside a height band, by the height
// of its end. Heights at the band's ends are inside.
[[nodiscard]] BandPart part_in_band(const HeightBand& band, const Sensor& sensor,
                                    std::int32_t end_z, std::uint32_t reach_mm);

}  // namespace iog::vehicle
