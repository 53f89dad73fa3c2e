// iog mount: how the units that turn are mounted, by the ground that they see.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lidar/formats.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/identity/car_capture.hpp"
#include "tools/mount/motion_log.hpp"
#include "tools/mount/mount_fit.hpp"
#include "tools/mount/mount_words.hpp"
#include "tools/mount/unit_turns.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/table.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

struct MountOptions {
  DriveFiles drive;
  std::string vehicle = kDefaultVehicle;
};

struct TurningUnit {
  const description::SensorConfig* sensor;
  UnitTurns turns;
};

std::vector<TurningUnit> turning_units_of(const CatalogueEntry& car) {
  std::vector<TurningUnit> units;
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    if (lidar::turns(car.sensors[i].format)) {
      units.push_back({&car.sensors[i], UnitTurns(car, i)});
    }
  }
  if (units.empty()) {
    throw UsageError(std::string(car.vehicle->name) +
                     " has no sensor that turns, and others see too little of the ground");
  }
  return units;
}

void read(const MountOptions& options, const CatalogueEntry& car, std::vector<TurningUnit>& units,
          MotionLog& motion) {
  CarCapture capture(options.drive, car);
  Progress progress("packets");
  while (const std::optional<CapturedDatagram> datagram = capture.next()) {
    motion.add(datagram->time_us, datagram->payload);
    for (TurningUnit& unit : units) {
      unit.turns.take(*datagram);
    }
    progress.show(capture.files().datagrams(), capture.files().part_read());
  }
  warn_of(options.drive, capture);
  for (TurningUnit& unit : units) {
    unit.turns.finish();
  }
  motion.sort();
}

std::string words_of_others(const CatalogueEntry& car) {
  std::string names;
  for (const description::SensorConfig& sensor : car.sensors) {
    if (!lidar::turns(sensor.format)) {
      names += (names.empty() ? "" : ", ") + std::string(sensor.name);
    }
  }
  return names.empty() ? "" : row("left out", names + ": they do not turn");
}

void fit_mounts(const MountOptions& options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  std::vector<TurningUnit> units = turning_units_of(car);
  demand_fit(options.drive.captures, car);
  MotionLog motion;
  read(options, car, units, motion);
  std::string lines;
  std::string refused;
  for (const TurningUnit& unit : units) {
    const MountFit fit = fit_of(unit.turns, motion);
    std::cout << words_of(fit, unit.turns, *unit.sensor) << '\n';
    const std::string name(unit.sensor->name);
    if (fit.refusal.empty()) {
      lines += "# " + name + "\n" + toml_of(fit, unit.sensor->mount);
    } else {
      refused += (refused.empty() ? "" : "; ") + name + ": " + fit.refusal;
    }
  }
  std::cout << words_of_others(car) << lines;
  if (!refused.empty()) {
    throw CheckFailed("no mount of " + refused);
  }
}

}  // namespace

void add_mount(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "mount", "Estimate the mounts of a car's spinning lidars from a recording of the road");
  const auto options = std::make_shared<MountOptions>();
  add_drive_options(*command, *command, options->drive, kCapturesHelp)->required();
  add_vehicle_options(*command, options->vehicle);
  command->footer(
      "mount prints the estimate and its uncertainty for each unit, then a `mount` line for the "
      "car file. x, y and yaw stay as they are in the file, which may be wrong by 10 degrees and 1 "
      "m. Record a drive of at least 15 s on an even road. If there are poses, turns of the lidar "
      "are left out while the car stands, brakes or turns. If too little ground was seen, or parts "
      "of the drive disagree, mount prints no line and exits with status 1 (docs/sensors.md).");
  command->callback([options] { fit_mounts(*options); });
}

}  // namespace iog::tools
