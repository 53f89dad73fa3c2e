// The leaves of simulated drives, counted as lab/experiments counts them for table 4.7, and the
// bytes that they need beside the array's.
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string_view>

#include "fakes/cells_of.hpp"
#include "fusion/frame_fusion.hpp"
#include "lab/evidence/frame_points.hpp"
#include "lab/experiments/output_rates/scene_load.hpp"
#include "lab/tree/built_quadtree.hpp"
#include "lab/tree/grid_drawing.hpp"
#include "lab/tree/linear_quadtree.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tree {
namespace {

using tests::BuiltQuadtree;
using tests::GridDrawing;

static_assert(kGridSide == geometry::kCellsPerSide);

// The grids of a drive of one second, every fifth.
template <typename Use>
void for_each_grid(std::string_view scene, Use&& use) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  const auto fusion = std::make_unique<fusion::FrameFusion>(*car.vehicle);
  tools::Drive drive(car, 1, 1, tools::find_scene(scene));
  for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += 5) {
    fusion->clear();
    for (const lab::SensorPoint& seen : lab::points_of(drive, frame, car)) {
      fusion->add(car.vehicle->sensors[seen.sensor], seen.point);
    }
    fusion->finish();
    const auto cells = tests::cells_of(*fusion);
    use(GridDrawing().fill(
        [&cells](std::size_t x, std::size_t y) { return cells[y * kGridSide + x]; }));
  }
}

void expect_equal_cells(const LinearQuadtree& tree, const GridDrawing& grid) {
  std::size_t different = 0;
  for (std::uint32_t y = 0; y < kGridSide; ++y) {
    for (std::uint32_t x = 0; x < kGridSide; ++x) {
      different += std::size_t{tree.leaf_at({x, y}).index != grid.at(x, y)};
    }
  }
  EXPECT_EQ(different, 0U);
}

class DriveLeaves : public testing::TestWithParam<std::string_view> {};

TEST_P(DriveLeaves, AreAsManyAsTheTablesCountAndLossless) {
  BuiltQuadtree built;
  for_each_grid(GetParam(), [&built](const GridDrawing& grid) {
    built.build(grid);
    const std::size_t leaves =
        lab::count_leaves(std::span(grid.cells()).first<geometry::kCellCount>());
    EXPECT_EQ(built->leaves(), leaves);
    EXPECT_EQ(built->nodes(), leaves + (leaves - 1) / 3);
    expect_equal_cells(*built, grid);
  });
}

// The thesis's quadtree needed 3.15 times the bytes of the array (section 4.3.2.2).
TEST_P(DriveLeaves, NeedLessThanHalfOfTheArray) {
  BuiltQuadtree built;
  for_each_grid(GetParam(), [&built](const GridDrawing& grid) {
    built.build(grid);
    EXPECT_LT(built->used_bytes(), grid.cells().size() / 2);
  });
}

INSTANTIATE_TEST_SUITE_P(Scenes, DriveLeaves, testing::Values("city", "ring_road"));

}  // namespace
}  // namespace iog::tree
