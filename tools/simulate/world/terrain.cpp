#include "tools/simulate/world/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace iog::tools {
namespace {

std::int32_t square_of(double metres, double side_m) {
  return static_cast<std::int32_t>(std::floor(metres / side_m));
}

double lowest(const Ray& ray, double from, double to) {
  return ray.from.z + (ray.along.z < 0 ? to : from) * ray.along.z;
}

}  // namespace

Terrain::Terrain(Road road, Profile profile)
    : road_(std::move(road)), profile_(std::move(profile)) {}

// A cell beside the tile, where a ray comes by rounding, is taken for the tile's last.
double Terrain::Tile::height_in(std::int32_t cell_x, std::int32_t cell_y, double x,
                                double y) const {
  const std::int32_t column = std::clamp(cell_x - first_x, 0, kCells - 1);
  const std::int32_t row = std::clamp(cell_y - first_y, 0, kCells - 1);
  const double right = x - first_x - column;
  const double low = at(column, row) + right * (at(column + 1, row) - at(column, row));
  const double high = at(column, row + 1) + right * (at(column + 1, row + 1) - at(column, row + 1));
  return low + (y - first_y - row) * (high - low);
}

// A node belongs to all the blocks that it is a corner of.
void Terrain::Tile::find_highest() {
  for (std::int32_t block = 0; block < kBlocks * kBlocks; ++block) {
    const std::int32_t first_column = block % kBlocks * kCellsOfBlock;
    const std::int32_t first_row = block / kBlocks * kCellsOfBlock;
    double top = at(first_column, first_row);
    for (std::int32_t row = first_row; row <= first_row + kCellsOfBlock; ++row) {
      for (std::int32_t column = first_column; column <= first_column + kCellsOfBlock; ++column) {
        top = std::max(top, at(column, row));
      }
    }
    highest_of_block[static_cast<std::size_t>(block)] = top;
  }
  highest = *std::ranges::max_element(highest_of_block);
}

// Where along the road a point is, is sought at every 16th node, 4 m apart; between them it is
// bilinear, which in a curve of 276 m radius is off by 7 mm at most.
Terrain::Tile Terrain::made(std::int32_t x, std::int32_t y) const {
  Tile tile{.first_x = x * kCells, .first_y = y * kCells};
  constexpr std::int32_t kStep = 16;
  constexpr std::int32_t kPlaces = kCells / kStep + 1;
  std::array<std::array<Road::Place, kPlaces>, kPlaces> places{};
  double station = road_.nearest(tile.first_x * kCellM, tile.first_y * kCellM).station;
  for (std::int32_t row = 0; row < kPlaces; ++row) {
    for (std::int32_t column = 0; column < kPlaces; ++column) {
      const Road::Place place = road_.nearest((tile.first_x + column * kStep) * kCellM,
                                              (tile.first_y + row * kStep) * kCellM, station);
      places.at(static_cast<std::size_t>(row)).at(static_cast<std::size_t>(column)) = place;
      station = place.station;
    }
  }
  const auto place_at = [&](std::int32_t column, std::int32_t row) {
    const auto left = static_cast<std::size_t>(std::min(column / kStep, kPlaces - 2));
    const auto low = static_cast<std::size_t>(std::min(row / kStep, kPlaces - 2));
    const double right = static_cast<double>(column) / kStep - static_cast<double>(left);
    const double up = static_cast<double>(row) / kStep - static_cast<double>(low);
    const auto between = [&](double Road::Place::*part) {
      const double below =
          places[low][left].*part + right * (places[low][left + 1].*part - places[low][left].*part);
      const double above = places[low + 1][left].*part +
                           right * (places[low + 1][left + 1].*part - places[low + 1][left].*part);
      return below + up * (above - below);
    };
    return Road::Place{between(&Road::Place::station), between(&Road::Place::left)};
  };
  for (std::int32_t row = 0; row < kNodes; ++row) {
    for (std::int32_t column = 0; column < kNodes; ++column) {
      const Road::Place place = place_at(column, row);
      const double height = profile_(place.station, place.left);
      tile.heights[index_of(column, row, kNodes)] = height;
    }
  }
  tile.find_highest();
  return tile;
}

const Terrain::Tile& Terrain::tile_at(std::int32_t x, std::int32_t y) const {
  const std::uint64_t key =
      std::uint64_t{static_cast<std::uint32_t>(x)} << 32U | static_cast<std::uint32_t>(y);
  auto found = tiles_.find(key);
  if (found == tiles_.end()) {
    found = tiles_.emplace(key, made(x, y)).first;
  }
  return found->second;
}

double Terrain::height_at(double x, double y) const {
  const Tile& tile = tile_at(square_of(x, kCells * kCellM), square_of(y, kCells * kCellM));
  return tile.height_in(square_of(x, kCellM), square_of(y, kCellM), x / kCellM, y / kCellM);
}

// Visits the squares of the plane that the ray crosses, in order, until one of them answers with a
// distance; kNoHit if none does. (Amanatides and Woo, 1987.)
template <typename Visit>
double Terrain::walk(const Ray& ray, double side_m, double from, double to, Visit&& visit) {
  const Vector3 begin = point_at(ray, from);
  Stretch stretch{square_of(begin.x, side_m), square_of(begin.y, side_m), from, from};
  const auto next_border = [&](double start, double step, std::int32_t square) {
    return step == 0 ? kNoHit : ((square + (step > 0 ? 1 : 0)) * side_m - start) / step;
  };
  while (stretch.enter < to) {
    const double border_x = next_border(ray.from.x, ray.along.x, stretch.x);
    const double border_y = next_border(ray.from.y, ray.along.y, stretch.y);
    stretch.leave = std::min({border_x, border_y, to});
    if (const double distance = visit(stretch); distance < kNoHit) {
      return distance;
    }
    stretch.enter = std::max(stretch.enter, stretch.leave);
    if (border_x <= border_y) {
      stretch.x += ray.along.x > 0 ? 1 : -1;
    } else {
      stretch.y += ray.along.y > 0 ? 1 : -1;
    }
  }
  return kNoHit;
}

// Over a bilinear square the ray's height over ground is a parabola, which three points tell.
double Terrain::distance_in_cell(const Tile& tile, const Ray& ray, const Stretch& stretch) {
  const auto over_ground = [&](double distance) {
    const Vector3 at = point_at(ray, distance);
    return at.z - tile.height_in(stretch.x, stretch.y, at.x / kCellM, at.y / kCellM);
  };
  const double length = stretch.leave - stretch.enter;
  const double first = over_ground(stretch.enter);
  const double last = over_ground(stretch.leave);
  if (first <= 0) {
    return stretch.enter;
  }
  if (last > 0) {
    return kNoHit;
  }
  const double middle = over_ground(stretch.enter + length / 2);
  const double bend = 2 * (first + last - 2 * middle);
  const double slope = last - first - bend;
  // The root in 0 ... 1 of bend t^2 + slope t + first, in the form that also holds for a line.
  const double root = std::sqrt(std::max(0.0, slope * slope - 4 * bend * first));
  return stretch.enter + length * std::clamp(2 * first / (root - slope), 0.0, 1.0);
}

double Terrain::distance_in_block(const Tile& tile, const Ray& ray, const Stretch& stretch) {
  const std::int32_t column = std::clamp(stretch.x - tile.first_x / kCellsOfBlock, 0, kBlocks - 1);
  const std::int32_t row = std::clamp(stretch.y - tile.first_y / kCellsOfBlock, 0, kBlocks - 1);
  if (lowest(ray, stretch.enter, stretch.leave) >
      tile.highest_of_block[index_of(column, row, kBlocks)]) {
    return kNoHit;
  }
  return walk(ray, kCellM, stretch.enter, stretch.leave,
              [&](const Stretch& cell) { return distance_in_cell(tile, ray, cell); });
}

double Terrain::distance_in_tile(const Ray& ray, const Stretch& stretch) const {
  const Tile& tile = tile_at(stretch.x, stretch.y);
  if (lowest(ray, stretch.enter, stretch.leave) > tile.highest) {
    return kNoHit;
  }
  return walk(ray, kCellM * kCellsOfBlock, stretch.enter, stretch.leave,
              [&](const Stretch& block) { return distance_in_block(tile, ray, block); });
}

double Terrain::distance_to_ground(const Ray& ray, double farthest) const {
  return walk(ray, kCells * kCellM, 0, farthest,
              [&](const Stretch& tile) { return distance_in_tile(ray, tile); });
}

Footing Terrain::under(const Placement& at, double half_length, double half_width) const {
  const auto height = [&](double forward, double left) {
    const Placement there = moved(at, forward, left);
    return height_at(there.x, there.y);
  };
  Footing footing{.z = height(0, 0)};
  if (half_length > 0) {
    footing.along = (height(half_length, 0) - height(-half_length, 0)) / (2 * half_length);
  }
  if (half_width > 0) {
    footing.left = (height(0, half_width) - height(0, -half_width)) / (2 * half_width);
  }
  return footing;
}

void Terrain::put(std::span<Solid> parts) const {
  if (parts.empty()) {
    return;
  }
  const Solid& base = parts.front();
  const Footing footing = under(
      base.at,
      base.material == Material::kCar || base.material == Material::kKerb ? base.half_length : 0,
      base.material == Material::kCar ? base.half_width : 0);
  const Placement origin = base.at;
  for (Solid& part : parts) {
    const double dx = part.at.x - origin.x;
    const double dy = part.at.y - origin.y;
    part.footing = footing;
    part.footing.z += footing.along * (dx * origin.cos + dy * origin.sin) +
                      footing.left * (dy * origin.cos - dx * origin.sin);
  }
}

}  // namespace iog::tools
