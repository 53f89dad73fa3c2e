// The thesis's fusion as it is printed, a baseline to compare with and nothing else: the general
// traversal of appendix B.3, the occupancy index of each cell from the lookup table of Table 4.3,
// and one saturated sum after the other as the points come (equation 4.4).
//
// Repaired is only what docs/model.md section 5 calls wrong: the start of the error, the sign of
// zero, and an end by count, because a loop that waits for the end cell can miss it. As in our own
// fusion the start cell is sampled too, a beam counts where it is inside the height band and the
// grid, and a scan point's fate says whether it carves and marks. The 1D cell of a cell is the one
// that its centre projects to (figure 4.8); the thesis does not print how.
//
// Integers only: this is what the Cortex-A9 of the thesis would have run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "index/occupancy_index.hpp"
#include "lidar/scan_point.hpp"
#include "sensor_model/profile.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

// Where the thesis's loop ends is not said: its table knows zeros behind the scan point.
enum class Extent : std::uint8_t {
  kToScanPoint,  // at the first cell behind the scan point in which no index is left
  kWholeBeam,    // at T, the end of the local grid, as printed; the same grid
};

class PrintedFusion {
 public:
  static constexpr std::size_t kCellCount =
      std::size_t{geometry::kCellsPerSide} * geometry::kCellsPerSide;

  // vehicle outlives the fusion.
  explicit PrintedFusion(const vehicle::Vehicle& vehicle, Extent extent = Extent::kToScanPoint);

  // Fuses one scan point. sensor is one of the vehicle's.
  void add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);

  // Row by row from the lowest y; complete at any time.
  [[nodiscard]] std::span<const index::OccupancyIndex, kCellCount> cells() const { return cells_; }

  // All cells back to unknown.
  void clear() { cells_.fill(index::kUnknown); }

 private:
  static constexpr std::int32_t kTableReach = sensor_model::kMaxNearCells + 1;

  // Table 4.3: [step + kTableReach] is the index of 1D cell k + step. Zero where the point's fate
  // does not let it carve or mark.
  using Table = std::array<index::OccupancyIndex, 2 * std::size_t{kTableReach} + 1>;
  struct Tables {
    Table carves_and_marks;
    Table carves;
    Table marks;
    [[nodiscard]] const Table& of(const vehicle::Classification& classification) const {
      return classification.evidence.carves()
                 ? (classification.evidence.marks() ? carves_and_marks : carves)
                 : marks;
    }
  };

  struct Segment;
  struct LocalGrid;

  // The part of a beam that counts, nothing if there is none.
  [[nodiscard]] std::optional<Segment> segment_of(const vehicle::Sensor& sensor,
                                                  const vehicle::Beam& beam,
                                                  const lidar::ScanPoint& point) const;
  void traverse(const Segment& segment, const LocalGrid& local);
  bool sample(std::int32_t l, std::int32_t m, const LocalGrid& local);

  const vehicle::Vehicle* vehicle_;
  Extent extent_;
  std::array<Tables, vehicle::kMaxSensors> tables_{};
  alignas(64) std::array<index::OccupancyIndex, kCellCount> cells_{};
};

}  // namespace iog::lab
