#include "tools/commands/vehicle_options.hpp"

#include <cmath>

#include "tools/program/add_option.hpp"
#include "tools/program/number_checks.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

constexpr double kMostClockOffsetS = 4e9;  // more than the years of any clock

std::optional<double> offset_in(const std::string& text) {
  double seconds = 0;
  if (!CLI::detail::lexical_cast(text, seconds) || !(std::abs(seconds) <= kMostClockOffsetS)) {
    throw CLI::ValidationError("--clock-offset", "seconds or auto, not " + text);
  }
  return seconds;
}

constexpr const char* kFileHelp = "Read the car from this file (docs/vehicles.md)";

}  // namespace

CLI::Validator known_vehicles() { return CLI::Validator('{' + vehicle_names() + '}'); }

CLI::Validator known_scenes() { return CLI::Validator('{' + scene_names() + '}'); }

void add_vehicle_options(CLI::App& command, std::string& name, const std::string& text) {
  auto* const by_name =
      add_option(command, "--vehicle", text, name, "A car that `iog vehicles` lists")
          ->check(known_vehicles())
          ->each([](const std::string& given) { give_vehicle(given); });
  command
      .add_option_function<std::string>(
          "--vehicle-file", [&name](const std::string& path) { name = add_vehicle_file(path); },
          kFileHelp)
      ->option_text("CAR.toml")
      ->excludes(by_name);
}

CLI::Option* add_vehicle_file_option(CLI::App& command) {
  return command
      .add_option_function<std::string>(
          "--vehicle-file", [](const std::string& path) { add_vehicle_file(path); }, kFileHelp)
      ->option_text("CAR.toml");
}

CLI::Option* add_clock_offset_option(CLI::App& command, std::optional<double>& seconds) {
  return add_option(command, "--clock-offset",
                    "SECONDS  (default 0; 37: packets by TAI, poses by UTC)", seconds,
                    "Add this to the times of the poses, if the clock of the packets is ahead")
      ->check(CLI::Range(-kMostClockOffsetS, kMostClockOffsetS));
}

CLI::Option* add_log_options(CLI::App& command, DriveFiles& drive, const std::string& text) {
  auto* const poses = command.add_option("--poses", drive.poses, text);
  poses->option_text("FILE | FOLDER");
  add_option(command, "--poses-mount", "X Y [YAW]  (metres, degrees)", drive.poses_mount,
             "Position of the logged receiver or lidar in the vehicle frame")
      ->expected(2, 3)
      ->needs(poses);
  add_option(command, "--poses-sigma", "MM MRAD  (default the log's, else 50 2)", drive.poses_sigma,
             "Standard deviations of the motion in one second")
      ->expected(2)
      ->check(above_zero())
      ->needs(poses);
  return poses;
}

CLI::Option* add_drive_options(CLI::App& all, CLI::App& command, DriveFiles& drive,
                               const std::string& text, const std::string& names) {
  auto* const pcap = command.add_option(names, drive.captures, text);
  pcap->option_text("FILE...");
  add_log_options(all, drive,
                  "Take the poses from this log: csv, nmea, ubx, oxts, tum, kitti, mcap or "
                  "rosbag2 (docs/drives.md)")
      ->needs(pcap);
  all.add_option_function<std::string>(
         "--clock-offset",
         [&drive](const std::string& given) {
           drive.finds_clock_offset = given == "auto";
           drive.clock_offset_s = drive.finds_clock_offset ? std::nullopt : offset_in(given);
         },
         "Add this to the times of the poses if the clock of the packets is ahead. auto: estimate "
         "it "
         "from the motion in the log and the capture")
      ->option_text("SECONDS | auto  (default 0; 37: packets by TAI, poses by UTC)")
      ->needs(pcap);
  return pcap;
}

}  // namespace iog::tools
