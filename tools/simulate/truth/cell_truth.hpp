// What is true of the cells of the world: what stands or moves in them, and how fast.
//
// Cells are as large as the car's and aligned to the world: cell (x, y) holds x <= X / cell_m < x +
// 1 of a point (X, Y), likewise y.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/program/file.hpp"
#include "tools/simulate/world/scene.hpp"

namespace iog::tools {

enum class TrueClass : std::uint8_t {
  kFree,            // nothing is there
  kMoving,          // a car or a person faster than kStandingMps
  kMovable,         // a car or a person that stands
  kInfrastructure,  // what cannot move: walls, poles, kerbs, trees, bushes, rails, banks
};

struct TrueCell {
  TrueClass what = TrueClass::kFree;
  std::uint32_t thing = 0;       // Solid::thing; 0 where nothing is
  std::uint32_t speed_mm_s = 0;  // to the nearest
  friend bool operator==(const TrueCell&, const TrueCell&) = default;
};

// Cells (x, y) to (x + width - 1, y + height - 1).
struct CellArea {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t width = 0;
  std::int32_t height = 0;
  double cell_m = geometry::kCellMm / 1000.0;
};

// The square of 1024 x 1024 cells in whose middle the car is: its middle cell holds the origin of
// the vehicle frame.
[[nodiscard]] CellArea cells_around(const EgoPose& ego, double cell_m = geometry::kCellMm / 1000.0);

// Row by row from the lowest y, cells that something covers in the vehicle's height band: at least
// the cell's centre lies in its outline. Where several do, what moves is named before what can
// move, and that before the rest; of one class the one that comes first. The car itself is not in
// it.
[[nodiscard]] std::vector<TrueCell> true_cells(const Scene& scene, double time_s,
                                               const CellArea& area,
                                               const description::Description& description);

// Their classes alone, in a byte each.
[[nodiscard]] std::vector<TrueClass> true_classes(const Scene& scene, double time_s,
                                                  const CellArea& area,
                                                  const description::Description& description);

// A CSV of what is not free: frame, time_us, y, x, cells, class, thing, speed_mm_s. A row is of so
// many cells side by side, from x on.
class CellTruthFile {
 public:
  // UsageError if it cannot be written.
  explicit CellTruthFile(const std::string& path);

  // time_us: on the clock of the packets.
  void write(std::uint32_t frame, std::uint64_t time_us, const CellArea& area,
             std::span<const TrueCell> cells);
  void finish() { file_.finish(); }

 private:
  OutputFile file_;
};

}  // namespace iog::tools
