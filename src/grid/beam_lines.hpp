// The lines of beams on the grid, kept from scan to scan.
//
// A lidar whose mirror stops at fixed azimuths asks for the same lines in every scan. Where a line
// runs, how far it stays in the grid and through which blocks it goes depends on the mount alone.
// So each line is found once and kept under its azimuth. Nobody has to say which azimuths a sensor
// has. If a line is not there, because its azimuth is new or another one took its place, it is
// found again; that costs more and gives the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "grid/block_path.hpp"
#include "grid/free_steps.hpp"
#include "traversal/ruler.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// A part of a line, from a cell up to a point between cells.
struct LinePart {
  traversal::Position first;
  Between end;

  [[nodiscard]] bool is_empty() const { return first.crossed() >= end.crossed(); }
  void begin_at(traversal::Position position) {
    if (position.crossed() > first.crossed()) {
      first = position;
    }
  }
  void end_at(Between point) {
    if (point.crossed() < end.crossed()) {
      end = point;
    }
  }
};

// The line of a sensor's beams at one azimuth, and what is known of it.
class KeptLine {
 public:
  void find(const vehicle::Sensor& sensor, const vehicle::Layer& layer,
            vehicle::Direction direction);

  [[nodiscard]] const vehicle::BeamLine& line() const { return line_; }

  // Borders crossed up to this distance. distance_mm is at most Sensor::range.
  [[nodiscard]] traversal::Position through(const vehicle::Sensor& sensor,
                                            std::uint32_t distance_mm) const {
    return ruler_.through(distance_mm, line_, sensor.range);
  }

  // The part of the line that lies in the grid, up to its end at Sensor::range.
  [[nodiscard]] const LinePart& in_grid() const { return in_grid_; }

  // Whether the line has a path: if it begins in the grid and meets no corner.
  [[nodiscard]] bool has_path() const { return has_path_; }
  BlockPath& path() {
    if (!path_begun_) {
      path_.begin(line_);
      path_begun_ = true;
    }
    return path_;
  }

 private:
  vehicle::BeamLine line_{{}, {}};
  traversal::Ruler<geometry::kResolution> ruler_{line_, {}};
  LinePart in_grid_;
  bool has_path_ = false;
  bool path_begun_ = false;
  BlockPath path_;
};

// What is known of the beams of one layer at one azimuth.
class KeptBeam {
 public:
  [[nodiscard]] bool is_found() const { return is_found_; }
  void find(std::int32_t end_z) {
    is_found_ = true;
    has_part_ = false;
    end_z_ = end_z;
  }

  // Height of the line's end in subcells.
  [[nodiscard]] std::int32_t end_z() const { return end_z_; }

  // The part of the line in the grid and in the height band, if it was kept.
  [[nodiscard]] bool has_part() const { return has_part_; }
  [[nodiscard]] LinePart part() const {
    return {{first_x_, first_y_}, {{end_x_, end_y_}, is_after_}};
  }
  // Keeps the part if it fits. A sensor on the grid has no line that is too long.
  void keep_part(const LinePart& part) {
    constexpr std::uint32_t kMost = 0xFFFF;
    has_part_ = part.first.crossed() <= kMost && part.end.crossed() <= kMost;
    first_x_ = static_cast<std::uint16_t>(part.first.x);
    first_y_ = static_cast<std::uint16_t>(part.first.y);
    end_x_ = static_cast<std::uint16_t>(part.end.at.x);
    end_y_ = static_cast<std::uint16_t>(part.end.at.y);
    is_after_ = part.end.is_after;
  }

 private:
  std::int32_t end_z_ = 0;
  std::uint16_t first_x_ = 0;
  std::uint16_t first_y_ = 0;
  std::uint16_t end_x_ = 0;
  std::uint16_t end_y_ = 0;
  bool is_after_ = false;
  bool has_part_ = false;
  bool is_found_ = false;
};

// The beams of one sensor at one azimuth. Kept are those of the first four layers, and their first
// two lines. The LUX has no more, and lidars with more layers turn freely.
class KeptAzimuth {
 public:
  static constexpr std::size_t kMaxLayers = 4;
  static constexpr std::size_t kMaxLines = 2;

  [[nodiscard]] bool is_of(const vehicle::Sensor& sensor, std::uint16_t ticks) const {
    return sensor_ == &sensor && ticks_ == ticks;
  }
  void begin(const vehicle::Sensor& sensor, std::uint16_t ticks);
  void forget() { sensor_ = nullptr; }

  // Layer::line of the layer is below kMaxLines.
  KeptLine& line_of(const vehicle::Sensor& sensor, const vehicle::Layer& layer,
                    vehicle::Direction direction);

  // The number of the layer is below kMaxLayers. The beam is empty until somebody fills it in.
  KeptBeam& beam_of(std::uint8_t layer) { return beams_[layer]; }

  // Whether the second line goes through the cells of the first up to and including this position.
  // Both lines were asked for before, and the first has a path. True is certain; false is not.
  [[nodiscard]] bool is_common(traversal::Position last);

 private:
  static constexpr std::uint32_t kNotKnown = std::numeric_limits<std::uint32_t>::max();

  const vehicle::Sensor* sensor_ = nullptr;
  std::uint16_t ticks_ = 0;
  std::array<bool, kMaxLines> is_found_{};
  std::uint32_t common_ = 0;             // the lines have so many cells in common,
  std::uint32_t different_ = kNotKnown;  // but may not have so many
  std::array<KeptBeam, kMaxLayers> beams_;
  std::array<KeptLine, kMaxLines> lines_;
};

// A fixed number of azimuths for each sensor; each has one place.
class BeamLines {
 public:
  explicit BeamLines(std::span<const vehicle::Sensor> sensors);

  KeptAzimuth& azimuth(const vehicle::Sensor& sensor, std::uint16_t ticks);

  // Forgets all lines, as after the start: each has to be found again.
  void forget();

 private:
  static constexpr std::size_t kPlaces = 2048;

  const vehicle::Sensor* first_sensor_;
  std::uint32_t places_per_sensor_ = kPlaces;  // a power of two
  std::array<KeptAzimuth, kPlaces> azimuths_;
};

}  // namespace iog::grid
