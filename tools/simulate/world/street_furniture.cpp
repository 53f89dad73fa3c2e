#include "tools/simulate/world/street_furniture.hpp"

#include <array>

#include "tools/simulate/world/road.hpp"

namespace iog::tools {
namespace {

constexpr CarShape kSmallCar{
    .length = 3.6, .width = 1.65, .bonnet_height = 0.95, .roof_height = 1.50, .cabin_share = 0.65};
constexpr CarShape kSaloon{};
constexpr CarShape kEstate{
    .length = 4.6, .width = 1.82, .bonnet_height = 0.92, .roof_height = 1.46, .cabin_share = 0.70};
constexpr CarShape kVan{
    .length = 5.1, .width = 1.95, .bonnet_height = 2.10, .roof_height = 2.10, .cabin_share = 0};

}  // namespace

CarShape some_car(Random& random) {
  constexpr std::array kShapes{kSmallCar, kSaloon, kSaloon, kEstate, kVan};
  return kShapes[random.below(kShapes.size())];
}

void add_car(const CarShape& shape, const Placement& at, std::vector<Solid>& solids) {
  solids.push_back(
      box(Material::kCar, at, shape.length, shape.width, shape.clearance, shape.bonnet_height));
  if (shape.cabin_share > 0) {
    solids.push_back(box(Material::kCar, moved(at, -0.08 * shape.length, 0),
                         shape.cabin_share * shape.length, 0.9 * shape.width, shape.bonnet_height,
                         shape.roof_height));
  }
}

void add_glazed_car(const CarShape& shape, const Placement& at, std::vector<Solid>& solids) {
  constexpr double kPillar = 0.08;
  constexpr double kRoof = 0.06;
  solids.push_back(
      box(Material::kCar, at, shape.length, shape.width, shape.clearance, shape.bonnet_height));
  if (shape.cabin_share == 0) {
    return;
  }
  const Placement cabin = moved(at, -0.08 * shape.length, 0);
  const double length = shape.cabin_share * shape.length;
  const double width = 0.9 * shape.width;
  for (const double side : {1.0, -1.0}) {
    for (const double along : {-0.5, 0.0, 0.5}) {
      solids.push_back(box(Material::kCar,
                           moved(cabin, along * (length - kPillar), side * (width - kPillar) / 2),
                           kPillar, kPillar, shape.bonnet_height, shape.roof_height - kRoof));
    }
  }
  solids.push_back(
      box(Material::kCar, cabin, length, width, shape.roof_height - kRoof, shape.roof_height));
}

void add_person(double x, double y, std::vector<Solid>& solids) {
  solids.push_back(cylinder(Material::kPerson, x, y, 0.24, 0, 1.75));
}

void add_tree(double x, double y, Random& random, std::vector<Solid>& solids) {
  solids.push_back(cylinder(Material::kPole, x, y, random.between(0.10, 0.22), 0, 3.0));
  solids.push_back(cylinder(Material::kFoliage, x, y, random.between(1.0, 2.0), 2.4, 6.0));
}

void add_bush(double x, double y, Random& random, std::vector<Solid>& solids) {
  // One statement for each draw: compilers evaluate arguments in different orders.
  const double radius = random.between(0.4, 1.1);
  const double height = random.between(0.6, 1.8);
  solids.push_back(cylinder(Material::kFoliage, x, y, radius, 0, height));
}

}  // namespace iog::tools
