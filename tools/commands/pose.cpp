// iog pose: a log of poses as the messages that the target places its frames by.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "map/block.hpp"
#include "tools/commands/signing_options.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/poses/jumps.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/poses/standing_car.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/number_checks.hpp"
#include "tools/program/option_use.hpp"
#include "tools/program/table.hpp"
#include "tools/replay/pace.hpp"
#include "tools/replay/udp_sender.hpp"
#include "tools/report/words.hpp"

namespace iog::tools {
namespace {

struct PoseLogOptions {
  std::string from;
  std::string standing;
  std::string format;
  std::string out;
  std::string target;
  std::uint16_t port = pose::kPosePort;
  double speed = 1;
  std::optional<double> clock_offset_s;
  std::optional<double> sigma_mm;
  std::optional<double> heading_sigma_mrad;
  std::vector<double> mount_m{0, 0};
  std::optional<std::uint32_t> run;
  std::string map;
  std::string origin;
  std::optional<double> map_sigma_mm;
  double map_heading_sigma_mrad = 2;
  SigningOptions signing;
};

// What a file says does not depend on the day; a target must know one sending from the next.
std::uint32_t run_of(const PoseLogOptions& options) {
  if (options.run) {
    return *options.run;
  }
  if (!options.out.empty()) {
    return 1;
  }
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

MapOrigin origin_in_block(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::span block(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (map::check(block) != map::Refusal::kNone) {
    throw UsageError(path + ": no map as iog map makes it");
  }
  return {map::Block(block).latitude(), map::Block(block).longitude()};
}

std::optional<PoseConversion::Map> map_of(const PoseLogOptions& options) {
  if (options.map.empty() && options.origin.empty()) {
    return std::nullopt;
  }
  if (!options.map_sigma_mm) {
    throw UsageError("give --map-sigma: how well the log knows where on the earth it is");
  }
  return PoseConversion::Map{
      .origin = options.map.empty() ? map_origin_in("--origin", options.origin)
                                    : origin_in_block(options.map),
      .sigma = wire_sigma(*options.map_sigma_mm / 1000, options.map_heading_sigma_mrad / 1000)};
}

// `used`: how many poses are those of the log; the others are interpolated.
void write(const std::vector<CapturedDatagram>& datagrams, std::size_t used,
           const std::string& path) {
  PcapWriter capture(path);
  for (const CapturedDatagram& datagram : datagrams) {
    capture.write(datagram);
  }
  capture.finish();
  std::cout << counted(used, "pose|poses in ") << path;
  if (datagrams.size() > used) {
    std::cout << ", and " << datagrams.size() - used << " interpolated between them";
  }
  std::cout << '\n';
}

void send(const std::vector<CapturedDatagram>& datagrams, const PoseLogOptions& options,
          CommandSigner signer) {
  UdpSender sender(options.target, {options.port});
  Pace pace(options.speed);
  std::size_t sent = 0;
  std::size_t refused = 0;
  for (const CapturedDatagram& datagram : datagrams) {
    pace.wait_for(datagram.time_us - datagrams.front().time_us);
    if (was_interrupted()) {
      break;
    }
    const std::vector<std::byte> message = signer.as_sent(pose::kPoseChannel, datagram.payload);
    ++(sender.send(0, message) ? sent : refused);
  }
  std::cout << counted(sent, "pose|poses sent, ") << refused
            << " refused by the system; worst delay " << pace.worst_delay_us() << " us\n";
  sender.demand_sent();
}

std::optional<double> thousandth_of(const std::optional<double>& value) {
  return value ? std::optional(*value / 1000) : std::nullopt;
}

void convert(const PoseLogOptions& options) {
  if (options.from.empty() == options.standing.empty()) {
    throw UsageError("give either --from, a log of poses, or --standing, a capture");
  }
  if (options.out.empty() == options.target.empty()) {
    throw UsageError("give either --out FILE or --target ADDRESS");
  }
  if (!options.standing.empty()) {
    if (options.out.empty()) {
      throw UsageError("--standing needs --out");
    }
    const std::uint64_t poses =
        write_with_standing_poses(options.standing, options.port, options.out);
    std::cout << options.out << ": " << options.standing << " with "
              << counted(poses, "pose|poses of a car that stands still\n");
    return;
  }
  if (!options.signing.key.empty() && options.target.empty()) {
    throw UsageError("--key needs --target: what is signed is signed for one run of a target");
  }
  PoseLog read = read_pose_log(options.from, options.format);
  const std::optional<PoseConversion::Map> map = map_of(options);
  if (map && !read.plane && !read.poses.empty()) {
    throw UsageError(options.from + ": no latitudes in it, so no place on a map");
  }
  if (const std::string far = map ? words_of_far_map(read, map->origin) : ""; !far.empty()) {
    throw UsageError(options.from + ": " + far);
  }
  const PoseConversion conversion{.mount_x_m = options.mount_m[0],
                                  .mount_y_m = options.mount_m[1],
                                  .sigma_m = thousandth_of(options.sigma_mm),
                                  .sigma_heading_rad = thousandth_of(options.heading_sigma_mrad),
                                  .run = run_of(options),
                                  .map = map};
  const ConvertedLog log = converted(std::move(read), conversion);
  demand_poses(log, options.from);
  PoseEncoder encoder;
  std::vector<CapturedDatagram> datagrams;
  const std::int64_t offset_us = std::llround(options.clock_offset_s.value_or(0) * 1e6);
  for (PoseSample sample : log.samples) {
    if (offset_us < 0 && sample.time_us < static_cast<std::uint64_t>(-offset_us)) {
      throw UsageError("--clock-offset: the first poses of " + options.from +
                       " would be before time 0");
    }
    sample.time_us += static_cast<std::uint64_t>(offset_us);
    datagrams.push_back(encoder.datagram_of(sample));
    datagrams.back().destination.port = options.port;
  }
  if (!options.target.empty()) {
    catch_interrupts();
  }
  const CommandSigner signer = signer_of(options.signing);
  std::vector<std::string> all = words_of(log);
  if (const JumpTime jumps = time_lost_by_jumps(datagrams);
      kOfManyLost * jumps.lost_us > jumps.all_us) {
    all.push_back(percent(jumps.lost_us, jumps.all_us) + " % of the time is " +
                  std::string(kLostByJumps));
  }
  for (const std::string& words : all) {
    std::cout << options.from << ": " << words << '\n';
  }
  options.out.empty() ? send(datagrams, options, signer) : write(datagrams, log.poses, options.out);
}

void add_map_options(CLI::App& command, PoseLogOptions& options) {
  CLI::Option* const map =
      add_option(command, "--map", "FILE", options.map,
                 "State the position on this map of `iog map` (.iogmap); for oxts, nmea and ubx");
  add_option(command, "--origin", "LAT,LON  (degrees)", options.origin,
             "Origin of the map, instead of --map")
      ->excludes(map);
  add_option(command, "--map-sigma", "MM  (required with a map)", options.map_sigma_mm,
             "Standard deviation of the logged position on the earth")
      ->check(CLI::Range(1.0, 65'535.0));
  add_option(command, "--map-heading-sigma", "MRAD  (default 2)", options.map_heading_sigma_mrad,
             "Standard deviation of the logged heading against true north")
      ->check(CLI::Range(0.01, 655.35));
}

}  // namespace

void add_pose(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "pose", "Make pose messages from a log of positions, or send them to a target");
  const auto options = std::make_shared<PoseLogOptions>();
  add_option(*command, "--from", "FILE | FOLDER", options->from, "Log to read");
  add_option(*command, "--standing", "FILE", options->standing,
             "Copy this capture of a standing car to --out, with poses");
  add_option(*command, "--format", "csv | oxts | nmea | ubx | tum | kitti | mcap", options->format,
             "Format of the log, if name and content do not show it")
      ->check(CLI::IsMember(std::vector<std::string>(kPoseFormats.begin(), kPoseFormats.end())));
  add_option(*command, "--out", "FILE", options->out, "Capture to write (.pcap)");
  add_option(*command, "--target", "ADDRESS", options->target,
             "IPv4 address to send to, instead of --out");
  add_option(*command, "--port", "PORT  (default 15010)", options->port, "UDP port of the target")
      ->check(CLI::Range(1, 65'535));
  add_option(*command, "--speed", "X", options->speed,
             "Speed: 1 as logged, 2 twice as fast, 0 as fast as possible")
      ->check(not_below_zero());
  add_option(*command, "--mount", "X Y  (metres, default 0 0)", options->mount_m,
             "Position of the logged receiver in the vehicle frame")
      ->expected(2);
  add_option(*command, "--sigma", "MM  (default the log's, else 50)", options->sigma_mm,
             "Standard deviation of the distance driven in one second")
      ->check(above_zero());
  add_option(*command, "--heading-sigma", "MRAD  (default the log's, else 2)",
             options->heading_sigma_mrad, "Standard deviation of the heading change in one second")
      ->check(above_zero());
  add_option(*command, "--run", "N  (default 1; with --target from the clock)", options->run,
             "Run number of the pose source")
      ->check(CLI::Range(1U, 0xFFFFFFFFU));
  add_clock_offset_option(*command, options->clock_offset_s);
  add_map_options(*command, *options);
  add_signing_options(*command, options->signing);
  add_listening_options(*command, options->signing);
  command->footer(
      "csv: the first line names the columns, at least time_s,x_m,y_m,heading_deg; speed_m_s, "
      "yaw_rate_deg_s, sigma_m and sigma_heading_deg if known. oxts: a folder of KITTI with "
      "timestamps.txt and data. nmea: RMC, GGA, HDT, VTG. ubx: NAV-PVT. tum: timestamp tx ty tz qx "
      "qy qz qw.\n"
      "kitti: a folder with times.txt, poses.txt and calib.txt. mcap: nav_msgs/Odometry, else "
      "base_link in /tf, else stamped poses; FILE.mcap:/topic names one of several. Latitude and "
      "longitude become "
      "metres east and north of the first position. docs/drives.md says how each is read.");
  command->callback([command, options] {
    demand_use(*command, !options->target.empty(), {"--speed"}, "--target");
    demand_use(*command, options->standing.empty(),
               {"--format", "--mount", "--sigma", "--heading-sigma", "--run", "--clock-offset",
                "--map", "--origin"},
               "--from");
    demand_use(*command, !options->map.empty() || !options->origin.empty(),
               {"--map-sigma", "--map-heading-sigma"}, "--map or --origin");
    convert(*options);
  });
}

}  // namespace iog::tools
