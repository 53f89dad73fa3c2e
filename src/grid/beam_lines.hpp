// A cache for the lines of beams on the grid. Lines remain in the cache from scan to scan.
//
// For example, a lidar whose mirror stops at fixed azimuths needs the same lines in every scan. The
// course of a line, its length in the grid, and the blocks that it crosses depend only on the
// mount. Each line is therefore computed once and cached by its azimuth. The azimuths of a sensor
// do not have to be known in advance. A line that is not in the cache is computed again, which
// takes time but does not change the result.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "grid/block_path.hpp"
#include "grid/line_part.hpp"
#include "traversal/ruler.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// The line size of the L1 and L2 caches, in which the cached beam lines and the grid compete for
// space.
inline constexpr std::size_t kCacheLineBytes = 32;

// The part of a line where a beam with a given end height is within a height band. The limits of
// this part are stored as fractions of the line's length.
class BandLimits {
 public:
  // A beam frees the whole part if its point is at least this far beyond the part, because the
  // uncertain zone in front of the point is then also beyond the part.
  [[nodiscard]] static std::uint32_t behind_mm(const vehicle::Sensor& sensor);

  BandLimits() = default;
  // `end_z` is the height of the line's end, in subcells.
  BandLimits(const vehicle::HeightBand& band, const vehicle::Sensor& sensor, std::int32_t end_z);

  // Returns the section of `part` that is within these limits.
  [[nodiscard]] LinePart within(const LinePart& part, const vehicle::BeamLine& line,
                                const traversal::Ruler<geometry::kResolution>& ruler) const {
    if (is_empty_) {
      return {part.first, {}};
    }
    return {is_from_start_ ? part.first
                           : std::max(part.first, Between::before(ruler.through(from_, line))),
            end_within(part, line, ruler)};
  }
  // Returns the end of within(). Use the result only if within() is not empty.
  [[nodiscard]] Between end_within(const LinePart& part, const vehicle::BeamLine& line,
                                   const traversal::Ruler<geometry::kResolution>& ruler) const {
    return std::max(part.first, std::min(part.end, Between::after(ruler.before(to_, line))));
  }

  // A beam frees the whole part if its point is at or beyond this distance, because the uncertain
  // zone in front of the point is then also beyond the part.
  [[nodiscard]] std::uint32_t is_free_before_mm() const { return is_free_before_mm_; }

  // Returns true if this layer's part of a line ends beyond the other layer's part.
  [[nodiscard]] bool ends_behind(const BandLimits& other) const {
    const traversal::Share& end = to_.share();
    const traversal::Share& other_end = other.to_.share();
    return end.numerator * other_end.denominator > other_end.numerator * end.denominator;
  }

 private:
  traversal::MeasuredShare to_;
  std::uint32_t is_free_before_mm_ = std::numeric_limits<std::uint32_t>::max();
  bool is_empty_ = false;
  bool is_from_start_ = true;
  traversal::MeasuredShare from_;
};

// The part of a line that a beam can free. A beam frees the whole part if its point is at or beyond
// `free_from_mm`, because the uncertain zone in front of the point is then also beyond the part.
struct FreePart {
  LinePart part;
  std::uint32_t free_from_mm = 0;  // > 0
};

// Caches a line and its properties for one azimuth of a sensor.
class alignas(kCacheLineBytes) KeptLine {
 public:
  void find(const vehicle::Sensor& sensor, const vehicle::Layer& layer, std::uint32_t azimuth_step);

  [[nodiscard]] const vehicle::BeamLine& line() const { return line_; }
  [[nodiscard]] std::uint32_t number() const { return number_; }  // Layer::line

  // Returns the number of borders that the line crosses up to this distance. The distance should be
  // at most Sensor::range. For greater distances, the result may be too small, but it is never less
  // than the number of borders up to the line's end.
  [[nodiscard]] traversal::Position through(const vehicle::Sensor& sensor,
                                            std::uint32_t distance_mm) const {
    return ruler_.through(distance_mm, line_, sensor.range);
  }

  // Returns the part of the line that is in the grid. The line ends at Sensor::range.
  [[nodiscard]] const LinePart& in_grid() const { return in_grid_; }

  // Returns the part of in_grid() in which a beam is within the height band.
  [[nodiscard]] LinePart in_band(const BandLimits& limits) const {
    return limits.within(in_grid_, line_, ruler_);
  }
  // Returns the end of in_band(). Use the result only if in_band() is not empty.
  [[nodiscard]] Between end_in_band(const BandLimits& limits) const {
    return limits.end_within(in_grid_, line_, ruler_);
  }

  // Returns the part of in_grid() in which a beam that ends at height `end_z` is within the band.
  [[nodiscard, gnu::noinline]] FreePart part_in(const vehicle::HeightBand& band,
                                                const vehicle::Sensor& sensor,
                                                std::int32_t end_z) const;

  // `end_at()` returns the boundary after the cell at distance `to_mm`. `part_between()` returns
  // the part from the cell at distance `from_mm` to the cell at distance `to_mm`, including both
  // cells.
  [[nodiscard]] Between end_at(const vehicle::Sensor& sensor, std::uint32_t to_mm) const {
    const Between first = in_grid_.first;
    return to_mm == 0 ? first
                      : std::clamp(Between::after(through(sensor, to_mm)), first,
                                   std::max(first, in_grid_.end));
  }
  [[nodiscard]] LinePart part_between(const vehicle::Sensor& sensor, std::uint32_t from_mm,
                                      std::uint32_t to_mm) const {
    return from_mm >= to_mm
               ? LinePart{in_grid_.first, in_grid_.first}
               : LinePart{std::max(in_grid_.first, Between::before(through(sensor, from_mm))),
                          end_at(sensor, to_mm)};
  }

  // Returns true if the line has a block path. A line has a block path if it begins in the grid and
  // does not pass through a corner.
  [[nodiscard]] bool has_path() const { return has_path_; }
  BlockPath& path(const BlockGrid& grid) {
    if (!path_begun_) {
      path_.begin(line_, grid);
      path_begun_ = true;
    }
    return path_;
  }

 private:
  // The members are declared in the order in which they are accessed. On the target, all members
  // except the path fill two cache lines.
  LinePart in_grid_;
  bool has_path_ = false;
  bool path_begun_ = false;
  std::uint16_t number_ = 0;
  traversal::Ruler<geometry::kResolution> ruler_{vehicle::BeamLine({}, {}), {}};
  vehicle::BeamLine line_{{}, {}};
  BlockPath path_;
};
// If the size of a KeptLine is an odd number of cache lines, consecutive KeptLines are spread over
// all sets of a cache.
static_assert(sizeof(KeptLine) / kCacheLineBytes % 2 == 1);

// The beam of one layer at one azimuth, with cached properties. On the target, a KeptBeam fills one
// cache line.
class KeptBeam {
 public:
  void find(const vehicle::Sensor& sensor, std::int32_t end_z, KeptLine& line);

  [[nodiscard]] KeptLine& line() const { return *line_; }
  [[nodiscard]] const vehicle::BeamRanges& ranges() const { return ranges_; }

  // Returns true if find_band() has computed the part within the height band. KeptHeight describes
  // end_z.
  [[nodiscard]] bool has_band() const { return in_band_.free_from_mm != 0; }
  void find_band(const vehicle::HeightBand& band, const vehicle::Sensor& sensor,
                 std::int32_t end_z) {
    in_band_ = line_->part_in(band, sensor, end_z);
  }
  [[nodiscard]] const FreePart& in_band() const { return in_band_; }

 private:
  vehicle::BeamRanges ranges_;
  FreePart in_band_;
  KeptLine* line_ = nullptr;
};

// Properties of a beam that are needed less often than those in KeptBeam.
class KeptHeight {
 public:
  void find(const vehicle::Layer& layer, const vehicle::Direction& direction);

  // Returns the height of the beam's end, in subcells.
  [[nodiscard]] std::int32_t end_z() const { return end_z_; }

  // Returns the part of the line in which the beam is low (vehicle::Sensor::moved). The part is
  // computed on first use.
  [[nodiscard]] const LinePart& low_part(const vehicle::Vehicle& vehicle,
                                         const vehicle::Sensor& sensor, const KeptLine& line) {
    if (!has_low_) {
      low_ = line.part_in(vehicle.low_band(sensor), sensor, end_z_).part;
      has_low_ = true;
    }
    return low_;
  }
  // Returns true if a return of this beam within the height band is a tall return.
  [[nodiscard]] bool is_tall(const vehicle::Sensor& sensor, std::uint32_t range_mm) const {
    return std::int64_t{end_z_ - sensor.origin_z} * range_mm >= sensor.tall.low;
  }

 private:
  LinePart low_;
  std::int32_t end_z_ = 0;
  bool has_low_ = false;
};

// The beams of one sensor at one azimuth. The first four layers and their first two lines are
// cached. Four layers and two lines are enough for a LUX, and also for a level rotating lidar,
// whose layers all share one line.
class KeptAzimuth {
 public:
  static constexpr std::size_t kMaxLayers = 4;
  static constexpr std::size_t kMaxLines = 2;

  KeptAzimuth() = default;
  KeptAzimuth(const KeptAzimuth&) = delete;
  KeptAzimuth& operator=(const KeptAzimuth&) = delete;

  [[nodiscard]] bool is_of(const vehicle::Sensor& sensor, std::uint32_t step) const {
    return sensor_ == &sensor && step_ == step;
  }
  void begin(const vehicle::Sensor& sensor, std::uint32_t step);

  // Returns true if another azimuth may evict this azimuth. This is the case if another azimuth has
  // requested the same slot since this azimuth was last used.
  [[nodiscard]] bool gives_way() { return !std::exchange(is_asked_for_, false); }
  void stay() { is_asked_for_ = true; }

  // Layer::line must be below kMaxLines.
  KeptLine& line_of(const vehicle::Sensor& sensor, const vehicle::Layer& layer);

  // Returns true if the layer's beam is cached.
  [[nodiscard]] bool has_beam(std::uint8_t layer) const {
    return layer < kMaxLayers && (beams_found_ >> layer & 1U) != 0;
  }
  [[nodiscard]] KeptBeam& beam(std::uint8_t layer) { return beams_[layer]; }

  // The layer number must be below kMaxLayers, and its Layer::line must be below kMaxLines.
  KeptBeam& find_beam(const vehicle::Sensor& sensor, std::uint8_t layer);
  // The beam must belong to this azimuth.
  [[nodiscard]] KeptHeight& height_of(const KeptBeam& beam) {
    return heights_[static_cast<std::size_t>(&beam - beams_.data())];
  }

  // Returns true if the two lines are known to share their first `cells` cells. `cells` must not be
  // 0. The second line must already be cached. If the result is true, the first line is also cached
  // and has a block path. The result may be false even if the lines share these cells.
  [[nodiscard]] bool is_common(std::uint32_t cells) {
    return cells <= common_ || (cells < different_ && find_common(cells));
  }
  [[nodiscard]] KeptLine& first_line() { return lines_[0]; }

 private:
  static constexpr std::uint32_t kNotKnown = std::numeric_limits<std::uint32_t>::max();

  bool find_common(std::uint32_t cells);

  const vehicle::Sensor* sensor_ = nullptr;
  std::uint32_t step_ = 0;
  std::array<bool, kMaxLines> has_line_{};
  bool is_asked_for_ = false;
  std::uint32_t beams_found_ = 0;
  std::uint32_t common_ = 0;     // the lines are known to share this many cells
  std::uint32_t different_ = 0;  // the lines may not share this many cells
  alignas(kCacheLineBytes) std::array<KeptBeam, kMaxLayers> beams_;
  std::array<KeptLine, kMaxLines> lines_;
  std::array<KeptHeight, kMaxLayers> heights_;
  // On the target, this padding increases the size of an azimuth from 45 to 49 cache lines. Without
  // the padding, about 45 azimuths would fill the 2,048 sets of the L2 cache, and further azimuths
  // would compete for the same sets.
  [[maybe_unused]] std::array<std::byte, 4 * kCacheLineBytes> apart_{};
};

// A cache with a fixed number of azimuths per sensor. Each azimuth maps to one slot. The azimuths
// of a LUX that measures in steps of a quarter of a degree map to distinct slots if there are at
// most six sensors. At the LUX's finest resolution (an eighth of a degree), its azimuths map to
// distinct slots if there are at most three sensors. With four sensors, nearly all azimuths still
// map to distinct slots.
class BeamLines {
 public:
  explicit BeamLines(std::span<const vehicle::Sensor> sensors);

  KeptAzimuth& azimuth(const vehicle::Sensor& sensor, std::uint32_t step);

 private:
  static constexpr std::uint32_t kPlaces = 3328;

  const vehicle::Sensor* first_sensor_;
  std::uint32_t places_per_sensor_;
  std::array<KeptAzimuth, kPlaces> azimuths_;
  KeptAzimuth spare_;  // for an azimuth whose slot is taken
};

}  // namespace iog::grid
