#include "tools/simulate/truth/true_occupancy.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/grid.hpp"
#include "tools/formats/picture/pgm.hpp"

namespace iog::tools {
namespace {

constexpr std::int32_t kSide = geometry::kCellsPerSide;
constexpr double kGridCellM = geometry::kCellMm / 1000.0;

double centre_of(std::int32_t cell) { return (cell - geometry::kOriginCell + 0.5) * kGridCellM; }

std::int32_t grid_cell_of(double metres) {
  const double cell = std::floor(metres / kGridCellM) + geometry::kOriginCell;
  return static_cast<std::int32_t>(std::clamp(cell, 0.0, double{kSide - 1}));
}

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

void draw(const Solid& solid, std::vector<bool>& occupied) {
  const double reach =
      std::sqrt(solid.half_length * solid.half_length + solid.half_width * solid.half_width);
  const double edge = kSide * kGridCellM / 2;
  if (std::abs(solid.at.x) - reach > edge || std::abs(solid.at.y) - reach > edge) {
    return;
  }
  for (std::int32_t y = grid_cell_of(solid.at.y - reach); y <= grid_cell_of(solid.at.y + reach);
       ++y) {
    for (std::int32_t x = grid_cell_of(solid.at.x - reach); x <= grid_cell_of(solid.at.x + reach);
         ++x) {
      if (covers(solid, centre_of(x), centre_of(y))) {
        occupied[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] = true;
      }
    }
  }
}

}  // namespace

std::vector<bool> true_occupancy(const EgoPose& ego, std::span<const Solid> solids,
                                 const description::Description& description) {
  std::vector<bool> occupied(static_cast<std::size_t>(kSide) * kSide, false);
  for (const Solid& solid : solids) {
    if (solid.z_low <= description.z_max_m && solid.z_high >= description.z_min_m) {
      draw(seen_from(ego.at, solid), occupied);
    }
  }
  return occupied;
}

void write_truth(const std::string& path, const std::vector<bool>& occupied) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(occupied.size());
  for (std::size_t row = kSide; row-- > 0;) {
    for (std::size_t x = 0; x < kSide; ++x) {
      pixels.push_back(occupied[row * kSide + x] ? 0 : 255);
    }
  }
  write_pgm(path, kSide, kSide, pixels);
}

}  // namespace iog::tools
