#include "lab/experiments/perception/truth.hpp"

#include <algorithm>

#include "numeric/elementary.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

double drive_seconds(std::uint64_t clock_us) {
  return static_cast<double>(clock_us - tools::kDriveStartUs) / 1e6;
}

}  // namespace

LocalToWorld::LocalToWorld(const pose::Pose& placed, const tools::Placement& truth)
    : placed_{placed.x_mm / 1000.0, placed.y_mm / 1000.0}, truth_{truth.x, truth.y} {
  const double heading = placed.heading / 0x1p32 * 2 * numeric::kPi;
  const double cos = numeric::cos(heading);
  const double sin = numeric::sin(heading);
  cos_ = truth.cos * cos + truth.sin * sin;
  sin_ = truth.sin * cos - truth.cos * sin;
}

LocalToWorld::Point LocalToWorld::at(double x_m, double y_m) const {
  const Point way = turned(x_m - placed_.x_m, y_m - placed_.y_m);
  return {truth_.x_m + way.x_m, truth_.y_m + way.y_m};
}

FrameTruth::FrameTruth(const PerceivedFrame& frame, const LocalToWorld& before) {
  const tools::Scene& scene = frame.drive->scene();
  const description::Description& description =
      *tools::find_vehicle(tools::kDefaultVehicle).description;
  for (const fusion::PlacedSlice& slice : frame.engine->slices()) {
    const double time_s = drive_seconds(slice.slice.middle_us);
    slices_.push_back({LocalToWorld(slice.pose, scene.ego_at(time_s).at),
                       TrueThings(scene, time_s, description)});
  }
  if (slices_.empty()) {
    const double time_s = static_cast<double>(frame.drive->frame_end_us(frame.number)) / 1e6;
    slices_.push_back({before, TrueThings(scene, time_s, description)});
  }
}

TrueThing FrameTruth::near(const HitCell& hit) const {
  const Slice& slice = slices_[hit.slice];
  const LocalToWorld::Point at = slice.to_world.centre_of(hit.cell);
  return slice.things.near(at.x_m, at.y_m);
}

bool FrameTruth::is_near_mover(geometry::Cell cell) const {
  const LocalToWorld::Point at = last().to_world.centre_of(cell);
  return std::ranges::any_of(
      slices_, [&at](const Slice& slice) { return slice.things.is_near_mover(at.x_m, at.y_m); });
}

}  // namespace iog::lab
