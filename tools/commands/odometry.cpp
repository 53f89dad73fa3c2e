// iog odometry: the motion of a car by the scans of its spinning lidars.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/odometry/motion_check.hpp"
#include "tools/odometry/motion_offset.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

struct OdometryOptions {
  DriveFiles drive;
  std::string vehicle = kDefaultVehicle;
  std::string out;
};

void compare(const OdometryOptions& options, const ConvertedLog& log,
             const std::vector<TurnPose>& turns) {
  for (const std::string& words : words_of(log)) {
    std::cout << options.drive.poses << ": " << words << '\n';
  }
  const MotionOffset offset = offset_by_motion(turns, log.samples);
  const std::int64_t offset_us = offset.refusal.empty() ? std::llround(offset.seconds * 1e6) : 0;
  if (const std::string words = words_of(check_of(turns, log.samples, offset_us)); !words.empty()) {
    throw CheckFailed(options.drive.poses + ": " + words + ": the log, its headings" +
                      (offset.refusal.empty() ? "" : ", its clock") +
                      " or the mount's yaw_deg are wrong");
  }
  if (!offset.refusal.empty()) {
    throw CheckFailed(options.drive.poses + ": no clock offset: " + offset.refusal);
  }
  std::cout << options.drive.poses << ": " << words_of(offset)
            << "; --clock-offset auto adds it to these\n";
}

void estimate(const OdometryOptions& options) {
  if (options.out.empty() && options.drive.poses.empty()) {
    throw UsageError("give --out FILE, or --poses FILE to compare with");
  }
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  demand_fit(options.drive.captures, car);
  std::optional<ConvertedLog> log;
  if (!options.drive.poses.empty()) {
    log = log_of(options.drive, car);
  }
  const std::vector<TurnPose> turns = motion_in(options.drive.captures, car);
  std::cout << options.drive.name() << ": " << words_of(turns) << '\n';
  if (!options.out.empty()) {
    OutputFile file(options.out);
    file.write(csv_of(turns));
    file.finish();
  }
  const auto motions = std::ssize(turns) - 1;
  const auto sure = std::ranges::count(turns.begin() + 1, turns.end(), true, &TurnPose::is_sure);
  if (2 * sure < motions) {
    throw CheckFailed(options.drive.name() + ": only " + std::to_string(sure) + " of " +
                      std::to_string(motions) + " turns determine the motion");
  }
  if (log) {
    compare(options, *log, turns);
  }
}

}  // namespace

void add_odometry(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "odometry",
      "Estimate the motion of a car from its spinning lidars, for a capture without poses");
  const auto options = std::make_shared<OdometryOptions>();
  auto& drive = options->drive;
  auto* const pcap = command->add_option("--pcap", drive.captures, kCapturesHelp);
  pcap->option_text("FILE...")->required();
  add_vehicle_options(*command, options->vehicle);
  command
      ->add_option("--out", options->out, "The log to write (.csv), for --poses of other commands")
      ->option_text("FILE");
  add_log_options(*command, drive, "Find by how much the clock of this log differs, by the motion");
  command->footer(
      "Each turn is registered in a map of the turns before. The log is in the vehicle frame of "
      "the first turn.\n"
      "Where the surroundings do not determine the motion, as on an empty plain or in a tunnel, "
      "its sigma is 1 m.");
  command->callback([options] { estimate(*options); });
}

}  // namespace iog::tools
