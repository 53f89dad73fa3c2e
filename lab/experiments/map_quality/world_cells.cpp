#include "lab/experiments/map_quality/world_cells.hpp"

#include <cmath>
#include <cstddef>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

constexpr std::int32_t kMargin = 100;  // cells

}  // namespace

WorldCells::WorldCells(const PerceivedFrame& frame)
    : area_{frame.window.first.x - kMargin, frame.window.first.y - kMargin,
            window::kCellsAcross + 2 * kMargin, window::kCellsAcross + 2 * kMargin},
      classes_(tools::true_classes(
          frame.drive->scene(), static_cast<double>(frame.drive->frame_end_us(frame.number)) / 1e6,
          area_, *tools::find_vehicle(tools::kDefaultVehicle).description)) {}

tools::TrueClass WorldCells::at(const LocalToWorld::Point& point) const {
  const auto x = static_cast<std::int32_t>(std::floor(point.x_m / kWindowCellM)) - area_.x;
  const auto y = static_cast<std::int32_t>(std::floor(point.y_m / kWindowCellM)) - area_.y;
  return classes_[static_cast<std::size_t>(y) * static_cast<std::size_t>(area_.width) +
                  static_cast<std::size_t>(x)];
}

}  // namespace iog::lab
