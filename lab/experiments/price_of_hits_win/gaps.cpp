// How much of a narrow gap comes out free.
#include <array>

#include "lab/experiments/price_of_hits_win/false_echoes.hpp"
#include "lab/experiments/price_of_hits_win/priced_fusions.hpp"

namespace iog::lab {
namespace {

constexpr std::uint64_t kGapStream = 83;  // of the seed's random numbers
constexpr std::array kGapWidths{0.2, 0.3, 0.5, 0.8, 1.0, 1.5};
constexpr std::array kGapDistances{10, 20, 30};
constexpr int kGapPlaces = 8;
constexpr double kWallDepth = 0.3;
constexpr double kBumper = 2.0;  // metres ahead of the car's origin

struct GapCells {
  std::size_t free = 0;
  std::size_t occupied = 0;
  std::size_t all = 0;
};

// A wall across the way with a gap from y_low to y_high, and a house far behind it.
std::vector<tools::Solid> wall_with_gap(double x, double y_low, double y_high) {
  constexpr double kHalfLength = 20;
  const auto piece = [x](double low, double high) {
    return box(tools::Material::kWall, {.x = x + kWallDepth / 2, .y = (low + high) / 2}, kWallDepth,
               high - low, 0, 3);
  };
  return {piece(-kHalfLength, y_low), piece(y_high, kHalfLength),
          box(tools::Material::kWall, {.x = 46, .y = 0}, 2, 80, 0, 6)};
}

// Gaps of that width with edges on borders of cells, from 1.6 m right of the axis to the left.
ByFusion<GapCells> look_through_gaps(StandingCar& car, const vehicle::Vehicle& vehicle,
                                     int distance_m, double width_m, tools::Random& random) {
  constexpr double kFirst = -1.6;
  constexpr double kApart = 0.4;
  ByFusion<GapCells> counts;
  for (int place = 0; place < kGapPlaces; ++place) {
    const double y_low = kFirst + kApart * place;
    const double x = kBumper + distance_m;
    const FramePoints points = car.look_at(wall_with_gap(x, y_low, y_low + width_m), random);
    const auto gap = cells_within(x, x + kWallDepth, y_low, y_low + width_m);
    const FrameEvidence evidence = project(vehicle, points, {});
    for (std::size_t i = 0; i < kPricedFusions.size(); ++i) {
      for (const std::int32_t index : fused_cells(evidence, kPricedFusions[i], gap)) {
        counts[i].free += index < 0 ? 1U : 0U;
        counts[i].occupied += index > 0 ? 1U : 0U;
        ++counts[i].all;
      }
    }
  }
  return counts;
}

}  // namespace

Table price_of_gaps(const Input& input) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  StandingCar standing(car);
  tools::Random random(input.seed, kGapStream);
  Table table("price_of_gaps",
              {"distance_m", "gap_m", "places", "fusion", "cells", "free_cells", "occupied_cells"});
  for (const int distance_m : kGapDistances) {
    for (const double width_m : kGapWidths) {
      const ByFusion<GapCells> counts =
          look_through_gaps(standing, *car.vehicle, distance_m, width_m, random);
      for (std::size_t i = 0; i < kPricedFusions.size(); ++i) {
        table.row(distance_m, width_m, kGapPlaces, name_of(kPricedFusions[i]), counts[i].all,
                  counts[i].free, counts[i].occupied);
      }
    }
  }
  return table;
}

}  // namespace iog::lab
