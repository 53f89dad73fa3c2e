// The worst frames that could be put together, beside those of a drive: what they mark, and what
// the code allows at most. What they cost is measured on the target.
#include "lab/scenarios/worst_frames.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fusion/frame_fusion.hpp"
#include "geometry/grid.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/experiments/fused_drive.hpp"
#include "lab/experiments/target_drive.hpp"
#include "lab/experiments/worst_frames/frame_limits.hpp"
#include "lidar/ibeo_lux.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

const tools::CatalogueEntry& car() { return tools::find_vehicle(tools::kDefaultVehicle); }

std::size_t marks_of(const tools::CapturedDatagram& datagram) {
  const vehicle::Sensor& sensor =
      car().vehicle->sensors[tools::sensor_of_port(car(), datagram.destination.port)];
  lidar::IbeoLux decoder;
  if (decoder.decode(datagram.payload) != lidar::DecodeStatus::kOk) {
    return 0;
  }
  std::size_t marks = 0;
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    const vehicle::Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
    marks += vehicle::classify(sensor, beam, point).evidence.marks() ? 1U : 0U;
  });
  return marks;
}

std::size_t marks_of(const std::vector<tools::CapturedDatagram>& frame) {
  std::size_t marks = 0;
  for (const tools::CapturedDatagram& datagram : frame) {
    marks += marks_of(datagram);
  }
  return marks;
}

// Of a mean frame.
double marks_of(const tools::SceneEntry& scene) {
  tools::Drive drive(car(), kTargetSeed, kTargetSeconds, scene);
  std::size_t marks = 0;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    marks += marks_of(drive.datagrams(frame));
  }
  return static_cast<double>(marks) / drive.frame_count();
}

double marks_of(const WorstFrame& worst) {
  std::size_t marks = 0;
  for (std::uint32_t frame = 0; frame < kMeasuredWorstFrames; ++frame) {
    marks += marks_of(worst_datagrams(worst, kTargetSeed, frame));
  }
  return static_cast<double>(marks) / kMeasuredWorstFrames;
}

Table frames() {
  Table table("worst_frames", {"frame", "sender", "strain", "marks"});
  for (const char* scene : kDrives) {
    table.row(scene, "drive", "", marks_of(tools::find_scene(scene)));
  }
  for (const WorstFrame& worst : all_worst_frames()) {
    table.row(worst.name, worst.is_forged ? "forged" : "lux", worst.strain, marks_of(worst));
  }
  return table;
}

Table limits() {
  Table table("frame_limits", {"points", "range_m", "cells_per_beam", "cells", "tiles", "cell_mm",
                               "frame_period_us", "rule", "core_sensors", "core_marks"});
  const vehicle::Vehicle& vehicle = *car().vehicle;
  const char* const rule = vehicle.rule == vehicle::FusionRule::kHitsWin ? "hits_win" : "bayes";
  const FrameLimits limits = frame_limits(vehicle);
  table.row(limits.points, limits.range_m, limits.cells_per_beam, limits.cells, limits.tiles,
            vehicle.grid.cell_mm, vehicle.frame_period_us, rule, vehicle::kMaxSensors,
            grid::kMaxMarks);
  return table;
}

}  // namespace

Tables worst_frames(const Input& /*input*/) { return {frames(), limits()}; }

}  // namespace iog::lab
