// The fusion of one frame: beams in, a grid of occupancy indexes out.
//
// Contract section 3. The frame starts from a grid of zeros. Saturated sums of negative indexes
// commute, so the order in which beams carve does not show, and beams of one line wait for one
// another: neighbours in a scan often share it, and then it is walked once. Marks wait in a list
// until finish(), for the same reason: marks commute among themselves, but not with carving.
// Whatever order the packets of a frame came in, the grid is the same to the byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "grid/open_line.hpp"
#include "index/occupancy_index.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

using index::OccupancyIndex;

inline constexpr std::int32_t kStride = vehicle::kCellsPerSide;
inline constexpr std::size_t kCellCount = std::size_t{vehicle::kCellsPerSide} * kStride;

// One cell that a scan point marks.
struct Mark {
  std::uint32_t offset : 24;  // cell y * kStride + x
  std::int32_t index : 8;     // above 0
};
static_assert(kCellCount <= (std::size_t{1} << 24) && sizeof(Mark) == 4);

// The most marks of one frame: 256 KiB of them, enough for a dual-return VLP-16 turn (57,600
// points). fits() tells before a packet is fused whether its points still find room.
inline constexpr std::size_t kMaxMarks = 65'536;

// Where a walk begins, and the number of crossed borders at which it ends.
struct WalkRange {
  traversal::Position first;
  std::uint32_t end = 0;
};

class FrameFusion {
 public:
  // vehicle outlives the fusion.
  explicit FrameFusion(const vehicle::Vehicle& vehicle) : vehicle_(&vehicle) {}

  // Whether that many points of this sensor can still be marked in this frame.
  [[nodiscard]] bool fits(const vehicle::Sensor& sensor, std::uint32_t points) const;

  // Carves the beam of this point, now or later, and remembers its mark. The point's layer and
  // azimuth are those of the sensor's format. Only if fits() said so.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);

  // Carves the beams that still wait.
  void carve_waiting();

  // The same, and applies the marks by the vehicle's fusion rule. Once per frame, after its last
  // point.
  void finish();

  // The grid, row by row from the lowest y, kStride cells a row. Complete after finish().
  [[nodiscard]] std::span<const OccupancyIndex, kCellCount> cells() const { return cells_; }

  // For whoever sends a part of the grid and sets it back to unknown on the way.
  [[nodiscard]] std::span<OccupancyIndex, kCellCount> cells() { return cells_; }

  // All cells back to unknown, no marks.
  void clear();

 private:
  OpenLine& open_line(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);
  [[nodiscard]] std::optional<WalkRange> range_to_carve(const OpenLine& open,
                                                        const lidar::ScanPoint& point,
                                                        const vehicle::Judgement& judgement,
                                                        traversal::Position hit) const;
  static void carve_later(OpenLine& open, const WalkRange& range, std::uint32_t range_mm);
  void carve(OpenLine& open);
  void mark(const OpenLine& open, traversal::Position hit, std::uint32_t range_mm);
  void mark_behind(const vehicle::Sensor& sensor, const vehicle::BeamLine& line,
                   const traversal::Stretch& inside, traversal::Position hit,
                   std::uint32_t range_mm);
  void remember(std::size_t offset, OccupancyIndex index);

  const vehicle::Vehicle* vehicle_;
  std::array<OpenLine, vehicle::kMaxLayers> open_lines_{};  // by Layer::line
  std::size_t mark_count_ = 0;
  std::array<Mark, kMaxMarks> marks_{};
  alignas(64) std::array<OccupancyIndex, kCellCount> cells_{};
};

// The most cells that one point of this sensor can mark: its own, and behind it those that its near
// 1D cells reach. A line of length d enters at most sqrt(2) d / cell + 2 further cells.
[[nodiscard]] constexpr std::uint32_t max_marks_per_point(const vehicle::Sensor& sensor) {
  const std::uint32_t near_mm = sensor.profile.near_after_count == 0
                                    ? 0
                                    : (sensor.profile.near_after_count + 1U) * sensor.precision_mm;
  return near_mm == 0 ? 1 : 1 + 2 + near_mm * 3 / (2 * vehicle::kCellMm);
}

}  // namespace iog::grid
