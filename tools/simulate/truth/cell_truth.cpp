#include "tools/simulate/truth/cell_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "geometry/grid.hpp"
#include "numeric/elementary.hpp"

namespace iog::tools {
namespace {

constexpr double kMoment = 0.001;  // seconds in which a speed is measured

std::int32_t cell_of(double metres, double cell_m) {
  return static_cast<std::int32_t>(std::floor(metres / cell_m));
}

bool can_move(Material material) {
  return material == Material::kCar || material == Material::kPerson;
}

TrueCell truth_of(const MovingSolid& solid) {
  const double speed = solid.way() / kMoment;
  TrueClass what = TrueClass::kInfrastructure;
  if (can_move(solid.begin.material)) {
    what = speed > kStandingMps ? TrueClass::kMoving : TrueClass::kMovable;
  }
  return {what, solid.begin.thing, static_cast<std::uint32_t>(numeric::round(speed * 1000))};
}

// Whether a names a cell before b.
bool goes_before(TrueClass a, TrueClass b) {
  return b == TrueClass::kFree || (a != TrueClass::kFree && a < b);
}

TrueClass class_of(const TrueCell& cell) { return cell.what; }
TrueClass class_of(TrueClass what) { return what; }

template <typename Cell>
void draw(const Solid& solid, const Cell& truth, const CellArea& area, std::vector<Cell>& cells) {
  const double reach =
      std::sqrt(solid.half_length * solid.half_length + solid.half_width * solid.half_width);
  const std::int32_t first_x = std::max(cell_of(solid.at.x - reach, area.cell_m), area.x);
  const std::int32_t first_y = std::max(cell_of(solid.at.y - reach, area.cell_m), area.y);
  const std::int32_t last_x =
      std::min(cell_of(solid.at.x + reach, area.cell_m), area.x + area.width - 1);
  const std::int32_t last_y =
      std::min(cell_of(solid.at.y + reach, area.cell_m), area.y + area.height - 1);
  for (std::int32_t y = first_y; y <= last_y; ++y) {
    for (std::int32_t x = first_x; x <= last_x; ++x) {
      const auto index =
          static_cast<std::size_t>(y - area.y) * static_cast<std::size_t>(area.width) +
          static_cast<std::size_t>(x - area.x);
      if (goes_before(class_of(truth), class_of(cells[index])) &&
          covers(solid, (x + 0.5) * area.cell_m, (y + 0.5) * area.cell_m)) {
        cells[index] = truth;
      }
    }
  }
}

// truth(solid): what is in the cells that it covers.
template <typename Cell, typename Truth>
std::vector<Cell> cells_of(const Scene& scene, double time_s, const CellArea& area,
                           const description::Description& description, Truth&& truth) {
  std::vector<Cell> cells(static_cast<std::size_t>(area.width) *
                          static_cast<std::size_t>(area.height));
  for (const MovingSolid& solid :
       scene.solids_between(time_s - kMoment / 2, time_s + kMoment / 2)) {
    if (solid.begin.z_low <= description.z_max_m && solid.begin.z_high >= description.z_min_m) {
      draw<Cell>(solid.at(0.5), truth(solid), area, cells);
    }
  }
  return cells;
}

constexpr std::array<std::string_view, 4> kClassNames{"free", "moving", "movable",
                                                      "infrastructure"};

}  // namespace

CellArea cells_around(const EgoPose& ego, double cell_m) {
  constexpr std::int32_t kSide = geometry::kCellsPerSide;
  return {cell_of(ego.at.x, cell_m) - kSide / 2, cell_of(ego.at.y, cell_m) - kSide / 2, kSide,
          kSide, cell_m};
}

std::vector<TrueCell> true_cells(const Scene& scene, double time_s, const CellArea& area,
                                 const description::Description& description) {
  return cells_of<TrueCell>(scene, time_s, area, description, truth_of);
}

std::vector<TrueClass> true_classes(const Scene& scene, double time_s, const CellArea& area,
                                    const description::Description& description) {
  return cells_of<TrueClass>(scene, time_s, area, description,
                             [](const MovingSolid& solid) { return truth_of(solid).what; });
}

CellTruthFile::CellTruthFile(const std::string& path) : file_(path) {
  file_.write("frame,time_us,y,x,cells,class,thing,speed_mm_s\n");
}

void CellTruthFile::write(std::uint32_t frame, std::uint64_t time_us, const CellArea& area,
                          std::span<const TrueCell> cells) {
  const auto width = static_cast<std::size_t>(area.width);
  const std::string when = std::to_string(frame) + ',' + std::to_string(time_us) + ',';
  std::string rows;
  for (std::size_t first = 0; first < cells.size(); first += width) {
    const std::span<const TrueCell> row = cells.subspan(first, width);
    const auto y = static_cast<std::int32_t>(first / width) + area.y;
    for (std::size_t x = 0; x < width;) {
      const TrueCell& cell = row[x];
      std::size_t end = x + 1;
      while (end < width && row[end] == cell) {
        ++end;
      }
      if (cell.what != TrueClass::kFree) {
        rows += when + std::to_string(y) + ',' +
                std::to_string(area.x + static_cast<std::int32_t>(x)) + ',' +
                std::to_string(end - x) + ',' +
                std::string(kClassNames[static_cast<std::size_t>(cell.what)]) + ',' +
                std::to_string(cell.thing) + ',' + std::to_string(cell.speed_mm_s) + '\n';
      }
      x = end;
    }
  }
  file_.write(std::string_view(rows));
}

}  // namespace iog::tools
