#include "lab/experiments/evidential/grids.hpp"

#include <array>
#include <cmath>
#include <ctime>

#include "decision/cell.hpp"
#include "geometry/cell.hpp"
#include "lab/experiments/perception/perceived_drive.hpp"
#include "lab/reference/evidential/sensor_part.hpp"
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
// Of this thread: experiments run side by side.
double cpu_ms() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
}

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

GridRun run_grid(const EvidentialDrive& drive, const Region& region, const SceneMap& map,
                 const GridChoice& choice, const GridUse& use) {
  PerceptionGrid grid(map.classes_of(region), choice.order, kOsmBelief, choice.parameters);
  GridRun run;
  for (const DriveScan& scan : drive.scans) {
    const double begin_ms = cpu_ms();
    const std::vector<SourceMass> sources = source_masses(scan, region, choice.lidar);
    const double middle_ms = cpu_ms();
    grid.scan(sources);
    run.source_ms += middle_ms - begin_ms;
    run.fusion_ms += cpu_ms() - middle_ms;
    use(scan, grid);
  }
  run.conflict = grid.conflict();
  run.source_ms /= static_cast<double>(drive.scans.size());
  run.fusion_ms /= static_cast<double>(drive.scans.size());
  return run;
}

void run_firmware(const EvidentialDrive& drive,
                  const std::function<void(const TrueScan&, const ByteOf&)>& use) {
  const PerceivedDrive perceived{.scene = drive.name,
                                 .seed = drive.seed,
                                 .seconds = drive.seconds,
                                 .poses = {.sigma_m = 0, .sigma_heading_rad = 0},
                                 .shown_every = EvidentialDrive::kFramesOfScore};
  constexpr std::array kOneRule{PerceptionRule{"default"}};
  perceive_drive(perceived, kOneRule, [&](const PerceivedFrame& frame) {
    const auto truth = drive.truth.find(frame.number);
    if (truth == drive.truth.end()) {
      return;
    }
    const auto number = [](double metres) {
      return static_cast<std::int32_t>(std::floor(metres / kWindowCellM));
    };
    use(truth->second, [&](const LocalToWorld::Point& at) -> std::int8_t {
      const geometry::Cell cell{number(at.x_m), number(at.y_m)};
      return frame.window.contains(cell) ? frame.classes.front()[frame.window.place_of(cell)] : 0;
    });
  });
}

ScoredRun score_grid(const EvidentialDrive& drive, const Region& region, const GridChoice& choice) {
  ScoredRun scored;
  scored.run = run_grid(drive, region, drive.map, choice, [&](const auto& scan, const auto& grid) {
    if (const auto truth = drive.truth.find(scan.frame); truth != drive.truth.end()) {
      scored.scores.add(truth->second, [&](const TruePoint& point) {
        return pignistic_word(grid, region.cell_of(point.at));
      });
    }
  });
  return scored;
}

}  // namespace iog::lab
