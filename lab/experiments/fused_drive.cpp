#include "lab/experiments/fused_drive.hpp"

#include <memory>
#include <vector>

#include "lab/evidence/frame_points.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {

void fuse_drive(std::string_view scene, std::uint64_t seed, std::uint32_t seconds,
                vehicle::FusionRule rule, const std::function<void(GridCells)>& use) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  vehicle::Vehicle vehicle = *car.vehicle;
  vehicle.rule = rule;
  const auto fusion = std::make_unique<fusion::FrameFusion>(vehicle);  // too large for the stack
  tools::Drive drive(car, seed, seconds, tools::find_scene(scene));
  std::vector<index::OccupancyIndex> storage(geometry::kCellCount);
  const auto cells = std::span(storage).first<geometry::kCellCount>();
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    fusion->clear();
    for (const SensorPoint& seen : points_of(drive, frame, car)) {
      fusion->add(vehicle.sensors[seen.sensor], seen.point);
    }
    fusion->finish();
    fusion->view().copy_cells(cells);
    use(cells);
  }
}

}  // namespace iog::lab
