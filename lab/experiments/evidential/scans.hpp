// A simulated drive as Kurdej's thesis sees it: what each lidar's scan found, by angle, and where
// its echoes are in the world.
//
// Every second frame of the drive is a scan, 12.5 a second: between the 10 of section 7.2 and the
// 15 of section 7.3. A lidar's scan is placed by where the car truly was in the middle of its sweep
// (section 7.1 takes the pose for precise), an echo that is scored by where it was at its own time.
// Ranges are taken along the ground: the steepest layer, 1.6 degrees, makes 2 cm at 50 m.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/experiments/perception/truth.hpp"
#include "lab/reference/evidential/lidar_models.hpp"
#include "tools/simulate/drives/drive.hpp"

namespace iog::lab {

struct LidarScan {
  tools::Placement at{};                        // of the sensor, in the world
  double time_s = 0;                            // of the drive
  std::vector<std::vector<double>> echoes_m{};  // by sector, from right to left
  std::vector<LocalToWorld::Point> echoes{};    // those that the car's grid would mark
};

struct DriveScan {
  std::uint32_t frame = 0;
  double time_s = 0;  // of the frame's end
  tools::Placement car{};
  std::vector<LidarScan> lidars{};
};

inline constexpr std::uint32_t kFramesOfScan = 2;

// All scans of the drive from that frame on.
[[nodiscard]] std::vector<DriveScan> scans_of(tools::Drive& drive, std::uint32_t first_frame);

// A square of cells that stays where it is in the world, row by row from the lowest y.
struct Region {
  double x_low_m = 0;
  double y_low_m = 0;
  double cell_m = 0.5;
  std::size_t side = 160;  // cells

  [[nodiscard]] std::size_t cell_count() const { return side * side; }
  [[nodiscard]] LocalToWorld::Point centre_of(std::size_t cell) const {
    const std::size_t row = cell / side;
    const std::size_t column = cell % side;
    return {x_low_m + (static_cast<double>(column) + 0.5) * cell_m,
            y_low_m + (static_cast<double>(row) + 0.5) * cell_m};
  }
  [[nodiscard]] bool contains(const LocalToWorld::Point& at) const {
    const double size_m = static_cast<double>(side) * cell_m;
    return at.x_m >= x_low_m && at.x_m < x_low_m + size_m && at.y_m >= y_low_m &&
           at.y_m < y_low_m + size_m;
  }
  // Of a point that it contains.
  [[nodiscard]] std::size_t cell_of(const LocalToWorld::Point& at) const {
    return static_cast<std::size_t>((at.y_m - y_low_m) / cell_m) * side +
           static_cast<std::size_t>((at.x_m - x_low_m) / cell_m);
  }
};

// The SourceGrids of a scan in the region's cells, all lidars joined.
[[nodiscard]] std::vector<reference::evidential::SourceMass> source_masses(
    const DriveScan& scan, const Region& region,
    const reference::evidential::LidarParameters& parameters);

}  // namespace iog::lab
