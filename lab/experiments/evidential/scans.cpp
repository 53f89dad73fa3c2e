#include "lab/experiments/evidential/scans.hpp"

#include <cmath>

#include "intake/packet.hpp"
#include "lidar/ibeo_lux.hpp"
#include "numeric/elementary.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/scanners/lux_scanner.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

using reference::evidential::LidarParameters;
using reference::evidential::PolarGrid;
using reference::evidential::SourceMass;

constexpr double kReachM = 50;
constexpr std::int32_t kTicksPerTurn = lidar::IbeoLux::kTicksPerTurn;

double radians_of(std::int32_t ticks) { return ticks * 2 * numeric::kPi / kTicksPerTurn; }

tools::Placement sensor_at(const tools::Placement& car, const description::MountConfig& mount) {
  const double yaw = mount.yaw_deg * numeric::kPi / 180;
  return tools::turned_by(tools::moved(car, mount.x_m, mount.y_m), numeric::cos(yaw),
                          numeric::sin(yaw));
}

double drive_seconds(std::uint64_t clock_us) {
  return static_cast<double>(clock_us - tools::kDriveStartUs) / 1e6;
}

class ScanReader {
 public:
  explicit ScanReader(const tools::Scene& scene)
      : car_(&tools::find_vehicle(tools::kDefaultVehicle)), scene_(&scene) {}

  DriveScan read(const std::vector<tools::CapturedDatagram>& datagrams) {
    DriveScan scan;
    scan.lidars.resize(car_->sensors.size());
    for (const tools::CapturedDatagram& datagram : datagrams) {
      const std::size_t sensor = tools::sensor_of_port(*car_, datagram.destination.port);
      const auto format = car_->vehicle->sensors[sensor].format;
      add(sensor, intake::Packet::decode(format, datagram.payload), scan.lidars[sensor]);
    }
    return scan;
  }

 private:
  void add(std::size_t sensor, const intake::Packet& packet, LidarScan& lidar) const {
    const lidar::Sweep& sweep = packet.info().sweep;
    lidar.time_s = (drive_seconds(sweep.begin_us) + drive_seconds(sweep.end_us)) / 2;
    lidar.at = sensor_at(scene_->ego_at(lidar.time_s).at, car_->sensors[sensor].mount);
    lidar.echoes_m.resize(tools::kLuxAzimuths);
    packet.for_each_point([&](const lidar::ScanPoint& point) { add(sensor, sweep, point, lidar); });
  }

  // Ground, dirt, rain, what is above or below the car and the car itself are not in the scan.
  void add(std::size_t number, const lidar::Sweep& sweep, const lidar::ScanPoint& point,
           LidarScan& lidar) const {
    const vehicle::Sensor& sensor = car_->vehicle->sensors[number];
    const auto beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
    const vehicle::Classification what = vehicle::classify(sensor, beam, point);
    if (!what.evidence.marks() && what.fate != vehicle::Fate::kTooFar) {
      return;
    }
    const std::int32_t ticks = point.azimuth_ticks < kTicksPerTurn / 2
                                   ? point.azimuth_ticks
                                   : point.azimuth_ticks - kTicksPerTurn;
    const double range_m = point.range_mm / 1000.0;
    const auto sector = (ticks + tools::kLuxEdgeTicks) / tools::kLuxStepTicks;
    lidar.echoes_m[static_cast<std::size_t>(sector)].push_back(range_m);
    if (what.evidence.marks()) {
      const tools::Placement from =
          sensor_at(scene_->ego_at(time_of(sweep, ticks)).at, car_->sensors[number].mount);
      const double azimuth = radians_of(ticks);
      const tools::Placement at =
          tools::moved(from, range_m * numeric::cos(azimuth), range_m * numeric::sin(azimuth));
      lidar.echoes.push_back({at.x, at.y});
    }
  }

  // The mirror turns evenly from left to right.
  static double time_of(const lidar::Sweep& sweep, std::int32_t ticks) {
    const double share = (tools::kLuxEdgeTicks - ticks) / (2.0 * tools::kLuxEdgeTicks);
    const double begin_s = drive_seconds(sweep.begin_us);
    return begin_s + share * (drive_seconds(sweep.end_us) - begin_s);
  }

  const tools::CatalogueEntry* car_;
  const tools::Scene* scene_;
};

PolarGrid polar_grid(const LidarScan& lidar, double cell_m, const LidarParameters& parameters) {
  return {{.first_rad = radians_of(-tools::kLuxEdgeTicks),
           .step_rad = radians_of(tools::kLuxStepTicks),
           .sectors = tools::kLuxAzimuths,
           .cell_m = cell_m,
           .cells = static_cast<std::size_t>(kReachM / cell_m)},
          lidar.echoes_m,
          parameters};
}

}  // namespace

std::vector<DriveScan> scans_of(tools::Drive& drive, std::uint32_t first_frame) {
  ScanReader reader(drive.scene());
  std::vector<DriveScan> scans;
  for (std::uint32_t frame = first_frame; frame < drive.frame_count(); frame += kFramesOfScan) {
    DriveScan& scan = scans.emplace_back(reader.read(drive.datagrams(frame)));
    scan.frame = frame;
    scan.time_s = static_cast<double>(drive.frame_end_us(frame)) / 1e6;
    scan.car = drive.scene().ego_at(scan.time_s).at;
  }
  return scans;
}

std::vector<SourceMass> source_masses(const DriveScan& scan, const Region& region,
                                      const LidarParameters& parameters) {
  std::vector<SourceMass> masses(region.cell_count());
  for (const LidarScan& lidar : scan.lidars) {
    const PolarGrid polar = polar_grid(lidar, region.cell_m, parameters);
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const LocalToWorld::Point centre = region.centre_of(i);
      const double x = centre.x_m - lidar.at.x;
      const double y = centre.y_m - lidar.at.y;
      const double ahead = lidar.at.cos * x + lidar.at.sin * y;
      const double left = lidar.at.cos * y - lidar.at.sin * x;
      const double range_m = std::sqrt(x * x + y * y);
      if (range_m < kReachM) {
        masses[i] = joined(masses[i], polar.at(range_m, std::atan2(left, ahead)));
      }
    }
  }
  return masses;
}

}  // namespace iog::lab
