// The occupancy grid of the many-core paper, cell by cell (CBC) and beam by beam (BBB), on one core
// and in double precision (sections II and III there). No heap, so that it runs on the target, too.
//
// The plane is the vehicle frame, in metres. A beam's field of view lies between the bisectors to
// its neighbours (figure 6): a cell belongs to the one beam whose field of view holds its centre.
// Each scan says something of a cell by the analytic sensor model (equation 4) at the distance of
// the cell's centre, and what several scans say is fused by equation 5.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "lab/reference/inverse_sensor_model.hpp"
#include "lidar/ibeo_lux.hpp"
#include "lidar/scan_point.hpp"
#include "tools/car/description.hpp"

namespace iog::lab::reference {

// Square cells, row by row from the lowest y, each row from the lowest x.
struct PlaneGrid {
  double x_min_m = 0;
  double y_min_m = 0;
  double cell_m = 0.1;  // > 0
  std::int32_t columns = 0;
  std::int32_t rows = 0;

  [[nodiscard]] double centre_x_m(std::int32_t column) const {
    return x_min_m + (column + 0.5) * cell_m;
  }
  [[nodiscard]] double centre_y_m(std::int32_t row) const { return y_min_m + (row + 0.5) * cell_m; }
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
};

struct Direction {
  double x = 1;
  double y = 0;
};

// The beams of one layer of a lidar: directions at a constant angular step, counted from the right
// to the left.
class Fan {
 public:
  static constexpr std::size_t kMaxBeams = 401;

  // The middle of the fan looks towards middle_rad. 1 ... kMaxBeams beams, step_rad > 0; the fan is
  // less than half a turn wide.
  Fan(double x_m, double y_m, double middle_rad, double step_rad, std::size_t beams);

  [[nodiscard]] double x_m() const { return x_m_; }
  [[nodiscard]] double y_m() const { return y_m_; }
  [[nodiscard]] std::size_t beams() const { return beams_; }
  [[nodiscard]] Direction direction(std::size_t beam) const { return directions_[beam]; }
  // The right border of a beam's field of view; that of beam + 1 is its left one.
  [[nodiscard]] Direction bisector(std::size_t beam) const { return bisectors_[beam]; }

  // Whether a point, seen from the fan's origin, lies in the beam's field of view. Every point of
  // the fan but its origin lies in that of exactly one beam.
  [[nodiscard]] bool sees(std::size_t beam, double dx_m, double dy_m) const {
    return is_left_of(bisectors_[beam], dx_m, dy_m) &&
           !is_left_of(bisectors_[beam + 1], dx_m, dy_m);
  }

  // The beam whose field of view that is, by an arc tangent.
  [[nodiscard]] std::optional<std::size_t> beam_of(double dx_m, double dy_m) const;

 private:
  [[nodiscard]] static bool is_left_of(Direction border, double dx_m, double dy_m) {
    return border.x * dy_m - border.y * dx_m >= 0;
  }

  double x_m_;
  double y_m_;
  double step_rad_;
  std::size_t beams_;
  Direction middle_;
  std::array<Direction, kMaxBeams> directions_{};
  std::array<Direction, kMaxBeams + 1> bisectors_{};
};

// What one layer measured: a range per beam of its fan, 0 where nothing came back.
struct PlaneScan {
  const Fan* fan = nullptr;
  std::span<const double> ranges_m;
};

// What was done to build a grid.
struct Operations {
  std::uint64_t searches = 0;  // CBC: for the beam of a cell. BBB: for a beam's cells at a distance
  std::uint64_t models = 0;    // evaluations of equation 4
  std::uint64_t fusions = 0;   // evaluations of equation 5
  std::uint64_t accesses = 0;  // to cells of the grid: CBC writes, BBB reads and writes
};

// Both overwrite the grid, of which `probabilities` has as many as it has cells.
//
// Cell by cell (figure 5a): for every cell and scan the beam is searched that sees the cell.
Operations cell_by_cell(const PlaneGrid& grid, std::span<const PlaneScan> scans,
                        const AnalyticModel& model, std::span<double> probabilities);

// Beam by beam (figure 5b): every beam is followed to stop_behind_m behind its range. Where the
// model is 1/2 from there on the grid is that of cell_by_cell(), to the bit: fused with 1/2, a
// probability stays what it is (equation 6).
Operations beam_by_beam(const PlaneGrid& grid, std::span<const PlaneScan> scans,
                        const AnalyticModel& model, double stop_behind_m,
                        std::span<double> probabilities);

// The scan points of one LUX as four scans in the plane: its layers are taken as independent.
// Sensors that are pitched or rolled are not supported.
class LuxScans {
 public:
  static constexpr std::size_t kLayers = lidar::IbeoLux::kElevationsDeg.size();
  static constexpr std::int32_t kEdgeTicks = 1600;  // 50 degrees to either side
  static constexpr std::int32_t kHalfDegree = lidar::IbeoLux::kTicksPerTurn / 720;

  // step_ticks between two directions: kHalfDegree or half of it.
  explicit LuxScans(const description::MountConfig& mount, std::int32_t step_ticks = kHalfDegree);

  // The first echo of a beam counts, unless the sensor calls it dirt or rain.
  void add(const lidar::ScanPoint& point);
  void clear() { ranges_m_ = {}; }

  // Valid as long as this object is.
  [[nodiscard]] std::array<PlaneScan, kLayers> scans() const;

 private:
  std::int32_t step_ticks_;
  Fan fan_;
  std::array<std::array<double, Fan::kMaxBeams>, kLayers> ranges_m_{};
};

// Equation 4 for a LUX. The paper gives the form and no numbers; these are ours: sigma as in the
// thesis, confidence falling from 0.9 to 0.7 over 50 m, and the probability of a missed obstacle
// rising from 0.05 to 0.25.
[[nodiscard]] AnalyticModel lux_model();

// From here on behind the range lux_model() is 1/2: lambda exp(-1.5^2 / 2) < 1/2 as lambda <= 0.9.
inline constexpr double kLuxStopBehindM = 0.15;

}  // namespace iog::lab::reference
