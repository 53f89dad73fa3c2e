// What ground is true of a place: road, house, or what is beside both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/simulate/truth/cell_truth.hpp"
#include "tools/simulate/world/site_plan.hpp"

namespace iog::tools {

enum class Ground : std::uint8_t {
  kBeside,  // pavements, parks, reservations, verges
  kRoad,    // carriageways and their parking strips, from kerb to kerb: drivable if it is free
  kHouse,   // also where a house reaches over a road
};

// Answers for a plan. A road is the quadrangles between the placements of its line, on each of
// which it is as wide as it is.
class TrueGround {
 public:
  explicit TrueGround(const SitePlan& plan);

  // Metres of the scene's world.
  [[nodiscard]] Ground at(double x, double y) const;

 private:
  struct Corner {
    double x;
    double y;
  };
  // Convex, counter-clockwise.
  struct Shape {
    std::array<Corner, 4> corners;
    Ground ground;
    [[nodiscard]] bool covers(double x, double y) const;
  };
  struct Box {
    double low_x;
    double low_y;
    double high_x;
    double high_y;
  };

  static Box box_of(const Shape& shape);
  void add(const Shape& shape) { shapes_.push_back(shape); }
  void add_road(const PlannedRoad& road);
  void sort_into_buckets();
  [[nodiscard]] std::size_t column_of(double x) const;
  [[nodiscard]] std::size_t row_of(double y) const;

  std::vector<Shape> shapes_;
  Box extent_{};
  std::size_t columns_ = 0;
  std::vector<std::vector<std::uint32_t>> buckets_;  // the shapes whose boxes meet them
};

// Row by row from the lowest y, by the cells' centres.
[[nodiscard]] std::vector<Ground> true_ground(const TrueGround& ground, const CellArea& area);

}  // namespace iog::tools
