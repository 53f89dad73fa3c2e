#include "tools/simulate/truth/true_occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "tools/car/tables.hpp"
#include "tools/formats/picture/pgm.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

constexpr std::string_view kMark = "truth of iogrid";  // by which iog knows its own pictures

// The cells of a grid along x or y.
struct Axis {
  double cell_m;
  std::int32_t cells;
  std::int32_t origin;

  [[nodiscard]] double centre_of(std::int32_t cell) const { return (cell - origin + 0.5) * cell_m; }
  [[nodiscard]] std::int32_t first_of(double metres) const {
    return static_cast<std::int32_t>(std::max(std::floor(metres / cell_m) + origin, 0.0));
  }
  [[nodiscard]] std::int32_t last_of(double metres) const {
    return static_cast<std::int32_t>(std::min(std::floor(metres / cell_m) + origin, cells - 1.0));
  }
};

// The solid in the vehicle frame, pitch left aside.
Solid seen_from(const Placement& ego, Solid solid) {
  const double dx = solid.at.x - ego.x;
  const double dy = solid.at.y - ego.y;
  const Placement at = solid.at;
  solid.at = {.x = dx * ego.cos + dy * ego.sin,
              .y = dy * ego.cos - dx * ego.sin,
              .cos = at.cos * ego.cos + at.sin * ego.sin,
              .sin = at.sin * ego.cos - at.cos * ego.sin};
  return solid;
}

void draw(const Solid& solid, const geometry::Grid& grid, std::vector<bool>& occupied) {
  const double cell_m = grid.cell_mm / 1000.0;
  const Axis along_x{cell_m, grid.columns, grid.origin_column};
  const Axis along_y{cell_m, grid.rows, grid.origin_row};
  const double reach =
      std::sqrt(solid.half_length * solid.half_length + solid.half_width * solid.half_width);
  for (std::int32_t y = along_y.first_of(solid.at.y - reach);
       y <= along_y.last_of(solid.at.y + reach); ++y) {
    for (std::int32_t x = along_x.first_of(solid.at.x - reach);
         x <= along_x.last_of(solid.at.x + reach); ++x) {
      if (covers(solid, along_x.centre_of(x), along_y.centre_of(y))) {
        occupied[static_cast<std::size_t>(geometry::number_of({x, y}, grid.columns))] = true;
      }
    }
  }
}

}  // namespace

std::vector<bool> true_occupancy(const EgoPose& ego, std::span<const Solid> solids,
                                 const description::Description& description) {
  const geometry::Grid grid = description::grid_of(description.grid);
  std::vector<bool> occupied(geometry::kCellCount, false);
  for (const Solid& solid : solids) {
    if (solid.z_low <= description.z_max_m && solid.z_high >= description.z_min_m) {
      draw(seen_from(ego.at, solid), grid, occupied);
    }
  }
  return occupied;
}

void make_truth_folder(const std::string& folder) {
  make_folder(folder);
  const std::vector<std::filesystem::path> pictures = numbered_files(folder, "truth", ".pgm");
  for (const std::filesystem::path& path : pictures) {
    if (!has_remark(path, kMark)) {
      throw UsageError(path.string() +
                       ": not written by this iog, or edited since; give another --truth");
    }
  }
  for (const std::filesystem::path& path : pictures) {
    std::filesystem::remove(path);
  }
}

void write_truth(const std::string& path, const std::vector<bool>& occupied,
                 const geometry::Grid& grid) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(std::size_t{grid.columns} * grid.rows);
  for (std::int32_t y = grid.rows; y-- > 0;) {
    for (std::int32_t x = 0; x < grid.columns; ++x) {
      const auto place = static_cast<std::size_t>(geometry::number_of({x, y}, grid.columns));
      pixels.push_back(occupied[place] ? 0 : 255);
    }
  }
  write_pgm(path, grid.columns, grid.rows, pixels, kMark);
}

}  // namespace iog::tools
