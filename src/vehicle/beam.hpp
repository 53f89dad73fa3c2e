// Computes the beam of a scan point. The result contains the point's outcome, the beam's line on
// the grid, and the part of the line that the beam carves (docs/model.md sections 5 and 6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {

// The outcome of a scan point. Each point has exactly one outcome. If several outcomes apply, the
// first one in this order is reported: no return, flagged as dirt or rain, too near, flagged as
// ground, too far, outside the height band or the ground limits, later echo, used. The values are
// sent on the wire (docs/spec.md).
enum class Fate : std::uint8_t {
  kUsed,               // carves and adds a hit
  kNoReturn,           // no evidence, or carves up to the sensor's no_return_clears_mm
  kTooNear,            // dropped: below the sensor's minimum range or on the car itself
  kTooFar,             // beyond the model's range; carves up to that range
  kOutsideHeightBand,  // carves the part of the beam inside the band
  kFlagged,            // carves if flagged as ground; dropped if flagged as dirt or rain
  kLaterEcho,          // adds a hit
  kMalformed,          // dropped because its packet is invalid or over budget
  kStale,              // dropped because its packet is a duplicate or late
  kNotTaken,           // dropped because its packet was shed by a target that is too slow
  // The next three outcomes replace kOutsideHeightBand for sensors that follow the ground. In all
  // three cases, the beam carves where it is between the ground limits.
  kGround,
  kOverhang,     // high enough above the ground to drive under it
  kUnderGround,  // a mirror image, a hole or a drop
};
inline constexpr std::size_t kFateCount = 13;

// A part of a line. `from` and `to` are fractions of the line's length, measured from its start.
// Unless the part is the entire line, `to` is at most 1.
struct BandPart {
  bool is_whole = true;
  bool is_empty = false;
  traversal::Share from;
  traversal::Share to;
};

// The cosine and sine of an azimuth, in units of 2^-30.
struct Direction {
  std::int32_t cosine = 0;
  std::int32_t sine = 0;
};

struct Beam {
  BeamLine line;
  std::int32_t end_z;  // height of the line's end in subcells
};

// A closed interval of ranges, in mm. The interval may be empty.
struct Ranges {
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t width = 0;

  [[nodiscard]] constexpr bool contain(std::uint32_t range_mm) const {
    return range_mm - first <= width;
  }
  friend constexpr bool operator==(const Ranges&, const Ranges&) = default;
};

// The ranges at which a point of the beam is on the car or in the height band. The interval
// `on_car` applies to the measured range, and `in_band` applies to the horizontal range along the
// line. Both regions are convex, so a single interval describes each of them.
struct BeamRanges {
  Ranges on_car;   // at least the sensor's minimum range
  Ranges in_band;  // at most L
};

// The evidence of a scan point. The evidence is stored as three bits of one word, which the
// compiler keeps in a register.
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

  // `carves()` returns true if the beam carves. `marks()` returns true if the point adds a hit.
  [[nodiscard]] constexpr bool carves() const { return (bits_ & kCarves) != 0; }
  [[nodiscard]] constexpr bool marks() const { return (bits_ & kMarks) != 0; }
  [[nodiscard]] constexpr bool is_any() const { return (bits_ & (kCarves | kMarks)) != 0; }
  // Returns true if the beam is inside the band from its start to the scan point. If the point lies
  // beyond L, the beam must be inside the band up to L.
  [[nodiscard]] constexpr bool is_whole_in_band() const { return (bits_ & kWhole) != 0; }
  // Returns true if all three bits are set.
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

// A point with evidence carves unless it is a later echo, because the first echo has already carved
// that beam. Used points and later echoes add a hit.
[[nodiscard]] constexpr Classification classified(Fate fate, bool is_evidence,
                                                  bool is_whole_in_band = false) {
  return {.fate = fate,
          .evidence = {is_evidence && fate != Fate::kLaterEcho,
                       fate == Fate::kUsed || fate == Fate::kLaterEcho, is_whole_in_band}};
}

// `azimuth_step` is a step of sensor.azimuths.
[[nodiscard]] Direction direction_of(const Sensor& sensor, std::uint32_t azimuth_step);

// `line_of()` returns the line of the layer's beam in this direction. `end_height_of()` returns the
// height of the line's end in subcells.
[[nodiscard]] BeamLine line_of(const Sensor& sensor, const Layer& layer, Direction direction);
[[nodiscard]] std::int32_t end_height_of(const Layer& layer, Direction direction);

// Returns the beam at the step nearest to an azimuth. Requires layer < sensor.layer_count.
// `azimuth_ticks` must be less than one turn.
[[nodiscard]] Beam aim(const Sensor& sensor, std::uint8_t layer, std::uint16_t azimuth_ticks);

// Returns the ranges between from_mm and to_mm at which points on the line are within `limits`
// along one axis. `extent` is the line's extent along this axis. The result is exact.
[[nodiscard]] Ranges ranges_between(const RangeProducts& limits, std::int32_t extent,
                                    std::uint32_t from_mm, std::uint32_t to_mm);

// These functions compute the two members of BeamRanges.
[[nodiscard]] Ranges ranges_on_car(const Sensor& sensor, const BeamLine& line);
[[nodiscard]] Ranges ranges_in_band(const Sensor& sensor, std::int32_t end_z);
// Returns the ranges at which a point is in the height band and counts as tall. Sensor::moved
// specifies which points are tall.
[[nodiscard]] Ranges tall_ranges(const Sensor& sensor, std::int32_t end_z);
[[nodiscard]] BeamRanges ranges_of(const Sensor& sensor, const Beam& beam);

// What the height of a return decides. `fate` is kUsed at the height of an obstacle, and otherwise
// the point's outcome. `is_whole` is true if the beam is at obstacle height from its start to the
// return.
struct Height {
  Fate fate = Fate::kUsed;
  bool is_whole = false;
};

// Classifies a point. `on_car` contains the ranges at which the point would be on the car.
// `along_mm` is the point's horizontal range (see Layer::along_line_mm()). `kNoReturn` and
// `kTooNear` are based on the measured range. All other range checks use along_mm.
// `height_at(reach_mm)` returns the Height at the horizontal range reach_mm. If the point lies
// beyond L, reach_mm is L, otherwise along_mm. The function is always inlined because it is called
// for every point.
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
  if (height.fate != Fate::kUsed) {
    return classified(height.fate, is_first);
  }
  return classified(is_first ? Fate::kUsed : Fate::kLaterEcho, true, height.is_whole);
}

// Classifies a point by the vehicle's height band. A beam is straight, so it is inside the band if
// both of its ends are.
[[nodiscard, gnu::always_inline]] constexpr Classification classify(const Sensor& sensor,
                                                                    const BeamRanges& ranges,
                                                                    const lidar::ScanPoint& point,
                                                                    std::uint32_t along_mm) {
  return classify(sensor, ranges.on_car, point, along_mm, [&](std::uint32_t reach_mm) {
    const bool ends_in_band = ranges.in_band.contain(reach_mm);
    return Height{.fate = ends_in_band ? Fate::kUsed : Fate::kOutsideHeightBand,
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

// Returns the part of a beam that is inside a height band, from the beam's origin up to reach_mm.
// Requires reach_mm <= L. `end_z` is the height of the beam's end. The limits of the band are
// inclusive.
[[nodiscard]] BandPart part_in_band(const HeightBand& band, const Sensor& sensor,
                                    std::int32_t end_z, std::uint32_t reach_mm);

}  // namespace iog::vehicle
