#include "lab/experiments/evidential/grids.hpp"

#include <cmath>

#include "decision/cell.hpp"
#include "geometry/cell.hpp"
#include "lab/experiments/keyed_car.hpp"
#include "lab/experiments/perceiver.hpp"
#include "lab/reference/evidential/sensor_part.hpp"
#include "tools/car/tables.hpp"
#include "tools/simulate/drives/pose_source.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

using reference::evidential::kFree;
using reference::evidential::kMoving;
using reference::evidential::kOccupied;
using reference::evidential::kStanding;
using reference::evidential::MassFunction;
using reference::evidential::PerceptionGrid;
using reference::evidential::pignistic_decision;
using reference::evidential::Set;
using reference::evidential::SourceMass;
using reference::evidential::without_map;

Region region_around(const tools::Placement& middle, double region_m) {
  Region region;
  region.side = static_cast<std::size_t>(region_m / region.cell_m);
  region.x_low_m = std::floor(middle.x - region_m / 2);
  region.y_low_m = std::floor(middle.y - region_m / 2);
  return region;
}

// What the car's own grid would hold of a cell that knows no map.
evidence::Cell cell_of(const MassFunction& mass) {
  const MassFunction lumped = without_map(mass);
  const auto units = [](double share) {
    return static_cast<std::int32_t>(share * evidence::kCertain);
  };
  return {.free = units(lumped[kFree]),
          .occupied = units(lumped[kOccupied]),
          .moving = units(lumped[kMoving]),
          .standing = units(lumped[kStanding])};
}

}  // namespace

EvidentialDrive::EvidentialDrive(std::string_view scene, std::uint64_t of_seed,
                                 std::uint32_t of_seconds, std::uint32_t first_frame,
                                 double region_m)
    : name(scene),
      seed(of_seed),
      seconds(of_seconds),
      drive(tools::find_vehicle(tools::kDefaultVehicle), of_seed, of_seconds,
            tools::find_scene(scene), tools::Motion::kContinuous),
      scans(scans_of(drive, first_frame)),
      region(region_around(scans[scans.size() / 2].car, region_m)),
      map(drive.scene()) {
  for (const DriveScan& scan : scans) {
    if (scan.frame >= first_frame + kUnscoredFrames &&
        scan.frame % kFramesOfScore == kFramesOfScore - 1) {
      truth.emplace(scan.frame, truth_of(scan, drive.scene(), map, region));
    }
  }
}

Word pignistic_word(const PerceptionGrid& grid, std::size_t cell) {
  return word_of(pignistic_decision(grid.said(cell)));
}

Word our_word(const PerceptionGrid& grid, std::size_t cell, Set map_classes) {
  const auto verdict =
      decision::verdict(cell_of(grid.cell(cell).mass), static_cast<std::uint8_t>(map_classes));
  return word_of(static_cast<decision::Class>(verdict.name), map_classes);
}

void run_grid(const EvidentialDrive& drive, const SceneMap& map, const GridChoice& choice,
              const GridUse& use) {
  PerceptionGrid grid(map.classes_of(drive.region), choice.order, kOsmBelief, choice.parameters);
  for (const DriveScan& scan : drive.scans) {
    grid.scan(source_masses(scan, drive.region, choice.lidar));
    use(scan, grid);
  }
}

void run_firmware(const EvidentialDrive& drive, double cell_m,
                  const std::function<void(const TrueScan&, const ByteOf&)>& use) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  description::Description description = *car.description;
  description.grid = {.cell_m = cell_m};
  std::vector<vehicle::Sensor> sensors;
  for (const description::SensorConfig& config : car.sensors) {
    sensors.push_back(description::sensor_of(config, description));
  }
  const bool has_objects = cell_m == car.description->grid.cell_m;
  const KeyedCar keyed(description::vehicle_of(description, sensors), {.has_objects = has_objects});
  Perceiver perceiver(keyed.vehicle(), {});
  tools::Drive packets(car, drive.seed, drive.seconds, tools::find_scene(drive.name),
                       tools::Motion::kContinuous);
  tools::PoseFeed poses(tools::simulated_poses(
      packets.scene(), {.sigma_m = 0, .sigma_heading_rad = 0}, drive.seed, drive.seconds + 0.1));
  for (std::uint32_t number = 0; number < packets.frame_count(); ++number) {
    for (const auto& datagram : tools::with_poses(packets.datagrams(number), poses)) {
      perceiver.take(datagram);
    }
    const auto truth = drive.truth.find(number);
    if (truth == drive.truth.end()) {
      continue;
    }
    const window::TileNumber corner = perceiver.area().corner();
    const std::vector<std::int8_t> classes = perceiver.classes();
    const auto number_in = [&](double metres, std::int32_t corner_tile) {
      return static_cast<std::int32_t>(std::floor(metres / cell_m)) -
             corner_tile * window::kTileSide;
    };
    use(truth->second, [&](const LocalToWorld::Point& at) -> std::int8_t {
      const geometry::Cell cell{number_in(at.x_m, corner.a), number_in(at.y_m, corner.b)};
      return window::kWindowCells.contains(cell)
                 ? classes[static_cast<std::size_t>(geometry::number_of(cell))]
                 : std::int8_t{0};
    });
  }
}

Scores score_grid(const EvidentialDrive& drive, const GridChoice& choice) {
  Scores scores;
  run_grid(drive, drive.map, choice, [&](const auto& scan, const auto& grid) {
    if (const auto truth = drive.truth.find(scan.frame); truth != drive.truth.end()) {
      scores.add(truth->second, [&](const TruePoint& point) {
        return pignistic_word(grid, drive.region.cell_of(point.at));
      });
    }
  });
  return scores;
}

}  // namespace iog::lab
