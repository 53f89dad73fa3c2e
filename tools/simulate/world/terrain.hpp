// The ground of a scene that is not flat: its height over the plane, given along a road and to its
// sides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>

#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

class Terrain {
 public:
  // Metres over the plane at a station of the road, `left` metres to the left of its centre line.
  using Profile = std::function<double(double station, double left)>;

  // The road's curves have radii that are longer than anybody sees to the side.
  Terrain(Road road, Profile profile);

  // Between the corners of squares of 0.25 m, where the profile says it, it is bilinear.
  [[nodiscard]] double height_at(double x, double y) const;

  // The way along the ray to where it first dips below the ground; kNoHit if it does not within
  // `farthest` metres.
  [[nodiscard]] double distance_to_ground(const Ray& ray, double farthest) const;

  // What is under an outline: the height under its middle, and slopes from end to end and from side
  // to side.
  [[nodiscard]] Footing under(const Placement& at, double half_length, double half_width) const;

  // Puts the parts of one thing on the ground, as they were put together on flat ground. Cars and
  // kerbs lie as the ground slopes, whatever else there is stands upright.
  void put(std::span<Solid> parts) const;

 private:
  static constexpr double kCellM = 0.25;
  static constexpr std::int32_t kCells = 64;  // of a tile, along each side
  static constexpr std::int32_t kNodes = kCells + 1;
  static constexpr std::int32_t kBlocks = 8;  // of a tile, along each side
  static constexpr std::int32_t kCellsOfBlock = kCells / kBlocks;

  // Where (column, row) of a square stands in an array, row by row.
  [[nodiscard]] static constexpr std::size_t index_of(std::int32_t column, std::int32_t row,
                                                      std::int32_t side) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(column);
  }

  struct Tile {
    std::int32_t first_x;  // its lowest cell
    std::int32_t first_y;
    std::array<double, static_cast<std::size_t>(kNodes) * kNodes> heights{};
    double highest = 0;
    // Of each square of 2 m within it, row by row.
    std::array<double, static_cast<std::size_t>(kBlocks) * kBlocks> highest_of_block{};
    [[nodiscard]] double at(std::int32_t column, std::int32_t row) const {
      return heights[index_of(column, row, kNodes)];
    }
    void find_highest();
    // At (x, y), in cells, which lies in that cell.
    [[nodiscard]] double height_in(std::int32_t cell_x, std::int32_t cell_y, double x,
                                   double y) const;
  };
  // A ray within a square of the plane: from one distance along it to another.
  struct Stretch {
    std::int32_t x;
    std::int32_t y;
    double enter;
    double leave;
  };

  [[nodiscard]] const Tile& tile_at(std::int32_t x, std::int32_t y) const;
  [[nodiscard]] Tile made(std::int32_t x, std::int32_t y) const;
  template <typename Visit>
  static double walk(const Ray& ray, double side_m, double from, double to, Visit&& visit);
  [[nodiscard]] double distance_in_tile(const Ray& ray, const Stretch& stretch) const;
  [[nodiscard]] static double distance_in_block(const Tile& tile, const Ray& ray,
                                                const Stretch& stretch);
  [[nodiscard]] static double distance_in_cell(const Tile& tile, const Ray& ray,
                                               const Stretch& stretch);

  Road road_;
  Profile profile_;
  // Made when they are first asked for.
  mutable std::unordered_map<std::uint64_t, Tile> tiles_;
};

}  // namespace iog::tools
