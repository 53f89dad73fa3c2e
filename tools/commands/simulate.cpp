// iog simulate: a drive that never was, as the capture that its scanners would have sent.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/commands/osm_options.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/map/map_readers.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/number_checks.hpp"
#include "tools/program/option_use.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/table.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/drives/pose_source.hpp"
#include "tools/simulate/maps/osm_file.hpp"
#include "tools/simulate/scenes/town.hpp"
#include "tools/simulate/truth/cell_truth.hpp"
#include "tools/simulate/truth/point_truth_file.hpp"
#include "tools/simulate/truth/true_occupancy.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

struct SimulateOptions {
  std::uint64_t seed = 1;
  std::uint32_t seconds = 10;
  std::string out;
  std::string truth;
  std::uint32_t truth_every = 25;
  std::string truth_cells;
  std::string truth_points;
  std::string vehicle = kDefaultVehicle;
  std::string scene = kDefaultScene;
  bool is_moving = false;
  bool has_attitude = false;
  double pose_rate_hz = 100;
  double pose_sigma_mm = 20;
  double pose_heading_sigma_mrad = 1;
  std::vector<std::string> pose_gaps;
  std::vector<std::string> pose_freezes;
  std::vector<std::string> pose_jumps;
  std::vector<double> pose_restarts_s;
  OsmOptions osm;
  std::string town;
  std::string town_origin;
};

// The two numbers of "2.5:0.3".
std::pair<double, double> pair_of(const std::string& option, const std::string& text) {
  std::pair<double, double> pair;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, pair.first);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == ':') {
    const auto second = std::from_chars(first.ptr + 1, end, pair.second);
    if (second.ec == std::errc() && second.ptr == end) {
      return pair;
    }
  }
  throw UsageError(option + " " + text + ": give seconds of the drive, a colon and a number");
}

// A fault of the poses that is not in the drive would have no effect.
void demand_in_drive(const SimulateOptions& options, const std::string& fault, double second) {
  if (!(second >= 0 && second < options.seconds)) {
    throw UsageError(fault + ": must begin within the drive (" + std::to_string(options.seconds) +
                     " s)");
  }
}

// From a second on, for so many seconds.
template <typename Fault>
std::vector<Fault> faults_of(const SimulateOptions& options, const std::string& option,
                             const std::vector<std::string>& texts) {
  std::vector<Fault> faults;
  for (const std::string& text : texts) {
    const auto [begin_s, length_s] = pair_of(option, text);
    demand_in_drive(options, option + ' ' + text, begin_s);
    if (!(length_s > 0)) {
      throw UsageError(option + ' ' + text + ": its length must be above 0");
    }
    faults.push_back({begin_s, length_s});
  }
  return faults;
}

PoseOptions pose_options(const SimulateOptions& options) {
  PoseOptions poses{
      .rate_hz = options.pose_rate_hz,
      .sigma_m = options.pose_sigma_mm / 1000,
      .sigma_heading_rad = options.pose_heading_sigma_mrad / 1000,
      .gaps = faults_of<PoseOptions::Gap>(options, "--pose-gap", options.pose_gaps),
      .freezes = faults_of<PoseOptions::Freeze>(options, "--pose-freeze", options.pose_freezes),
      .restarts_s = options.pose_restarts_s};
  for (const std::string& text : options.pose_jumps) {
    const auto [time_s, metres] = pair_of("--pose-jump", text);
    demand_in_drive(options, "--pose-jump " + text, time_s);
    poses.jumps.push_back({time_s, metres});
  }
  for (const double second : options.pose_restarts_s) {
    demand_in_drive(options, "--pose-restart " + CLI::detail::to_string(second), second);
  }
  return poses;
}

// The capture, and what is in it.
class DriveRecording {
 public:
  DriveRecording(const std::string& path, const CatalogueEntry& car)
      : path_(path), car_(&car), capture_(path) {}

  void write(const std::vector<CapturedDatagram>& datagrams) {
    for (const CapturedDatagram& datagram : datagrams) {
      capture_.write(datagram);
      if (sensor_of_port(*car_, datagram.destination.port) == car_->sensors.size()) {
        ++poses_;
      } else {
        ++packets_;
        bytes_ += datagram.payload.size();
      }
    }
  }

  void finish(std::uint32_t frames) {
    capture_.finish();
    std::cout << counted(frames, "frame|frames, ") << counted(packets_, "packet|packets, ")
              << bytes_ << " bytes of scans in " << path_;
    if (poses_ > 0) {
      std::cout << ", and " << counted(poses_, "pose|poses");
    }
    std::cout << '\n';
  }

 private:
  std::string path_;
  const CatalogueEntry* car_;
  PcapWriter capture_;
  std::uint64_t packets_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t poses_ = 0;
};

void write_cells(CellTruthFile& file, std::uint32_t frame, const Drive& drive,
                 const CatalogueEntry& car) {
  const CellArea area = cells_around(drive.ego(frame), car.description->grid.cell_m);
  file.write(frame, kDriveStartUs + drive.frame_end_us(frame), area,
             true_cells(drive.scene(), drive.true_at_s(frame), area, *car.description));
}

void write_osm(const SimulateOptions& options, const Scene& scene) {
  if (options.osm.out.empty()) {
    return;
  }
  const MapPlace place = map_place_of(options.osm);
  const DrawnMap map = drawn_map(scene, map_errors_of(options.osm),
                                 options.osm.seed.value_or(options.seed), options.seconds);
  OutputFile file(options.osm.out);
  file.write(std::string_view(osm_text(map, place, options.scene)));
  file.finish();
  std::cout << options.osm.out << ": " << summary_of(map) << "; plane at " << text_of(place.origin)
            << '\n';
}

Town town_of(const SimulateOptions& options) {
  const GeoMap map = read_osm(options.town);
  std::optional<MapOrigin> origin;
  if (!options.town_origin.empty()) {
    origin = map_origin_in("--town-origin", options.town_origin);
  }
  Town town = make_town(map, origin, options.seed, options.seconds);
  std::cout << options.town << ": " << summary_of(town) << "\n" << map.attribution << '\n';
  return town;
}

// The drive, and where it is on a map, if it is on one.
struct PlacedDrive {
  Drive drive;
  std::optional<pose::MapTransform> map{};
};

PlacedDrive placed_drive(const SimulateOptions& options, const CatalogueEntry& car) {
  if (!options.town.empty()) {
    Town town = town_of(options);
    if (options.has_attitude) {
      town.scene.attitude.emplace(options.seed);
    }
    return {Drive(car, options.seed, options.seconds, std::move(town.scene), Motion::kContinuous),
            town.place.transform()};
  }
  Scene scene = find_scene(options.scene).make(options.seed, options.seconds);
  if (options.has_attitude) {
    scene.attitude.emplace(options.seed);
  }
  const Motion motion = options.is_moving ? Motion::kContinuous : Motion::kStepwise;
  PlacedDrive placed{Drive(car, options.seed, options.seconds, std::move(scene), motion)};
  if (!options.osm.out.empty()) {
    placed.map = map_place_of(options.osm).transform();
  }
  return placed;
}

void simulate(const SimulateOptions& options) {
  if (options.out.empty() && options.osm.out.empty()) {
    throw UsageError("--out is required: the capture to write");
  }
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  PlacedDrive placed = placed_drive(options, car);
  Drive& drive = placed.drive;
  if (options.out.empty()) {
    write_osm(options, drive.scene());
    return;
  }
  std::optional<PoseFeed> poses;
  if (options.is_moving) {
    PoseOptions feed = pose_options(options);
    feed.map = placed.map;
    poses.emplace(simulated_poses(drive.scene(), feed, options.seed, options.seconds + 0.1),
                  car.vehicle->poses.udp_port);
  }
  if (!options.truth.empty()) {
    make_truth_folder(options.truth);
  }
  DriveRecording recording(options.out, car);
  std::optional<CellTruthFile> cells;
  if (!options.truth_cells.empty()) {
    cells.emplace(options.truth_cells);
  }
  std::optional<PointTruthFile> points;
  if (!options.truth_points.empty()) {
    points.emplace(options.truth_points);
  }
  write_osm(options, drive.scene());
  Progress progress("frames", drive.frame_count());
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    const bool is_told = frame % options.truth_every == 0;
    std::vector<SimulatedPacket> packets = drive.packets(frame);
    if (points && is_told) {
      points->write(frame, packets);
    }
    std::vector<CapturedDatagram> datagrams = datagrams_of(std::move(packets));
    if (poses) {
      datagrams = with_poses(std::move(datagrams), *poses);
    }
    recording.write(datagrams);
    if (!options.truth.empty() && is_told) {
      write_truth(numbered(options.truth, "truth", frame, ".pgm"),
                  true_occupancy(drive.ego(frame), drive.solids(frame), *car.description),
                  car.vehicle->grid);
    }
    if (cells && is_told) {
      write_cells(*cells, frame, drive, car);
    }
    progress.show(frame + 1);
  }
  if (cells) {
    cells->finish();
  }
  if (points) {
    points->finish();
  }
  recording.finish(drive.frame_count());
}

void add_truth_options(CLI::App& command, SimulateOptions& options, CLI::Option* moving) {
  add_option(command, "--truth", "FOLDER", options.truth,
             "Write the true occupancy as truth_NNNNNN.pgm into this folder");
  add_option(command, "--truth-cells", "FILE  (needs --moving)", options.truth_cells,
             "Write the ground truth of the cells as a .csv file")
      ->needs(moving);
  add_option(command, "--truth-points", "FILE  (needs --moving)", options.truth_points,
             "Write the ground truth of the points as a .csv file")
      ->needs(moving);
  add_option(command, "--truth-every", "N  (default 25)", options.truth_every,
             "Write the ground truth of every Nth frame")
      ->check(above_zero());
}

void add_pose_options(CLI::App& command, SimulateOptions& options, CLI::Option* moving) {
  add_option(command, "--pose-rate", "HZ  (1 to 125, default 100)", options.pose_rate_hz,
             "Poses per second")
      ->check(CLI::Range(1.0, 125.0))
      ->needs(moving);
  add_option(command, "--pose-sigma", "MM  (default 20)", options.pose_sigma_mm,
             "Standard deviation of the distance driven in one second, on each axis")
      ->check(CLI::Range(0.0, 10'000.0))
      ->needs(moving);
  add_option(command, "--pose-heading-sigma", "MRAD  (default 1)", options.pose_heading_sigma_mrad,
             "Standard deviation of the heading change in one second")
      ->check(CLI::Range(0.0, 500.0))
      ->needs(moving);
  add_option(command, "--pose-gap", "SECOND:SECONDS ...", options.pose_gaps,
             "Send no poses from SECOND on, for SECONDS")
      ->needs(moving);
  add_option(command, "--pose-freeze", "SECOND:SECONDS ...", options.pose_freezes,
             "Repeat the pose of SECOND with speed 0, for SECONDS")
      ->needs(moving);
  add_option(command, "--pose-jump", "SECOND:METRES ...", options.pose_jumps,
             "Shift all poses to the left by METRES, from SECOND on")
      ->needs(moving);
  add_option(command, "--pose-restart", "SECOND ...", options.pose_restarts_s,
             "Restart the pose source at SECOND")
      ->needs(moving);
}

void add_town_options(CLI::App& command, SimulateOptions& options, CLI::Option* moving,
                      CLI::Option* scene) {
  CLI::Option* const town =
      add_option(command, "--town", "FILE  (.osm, .osm.pbf, ...; needs --moving)", options.town,
                 "Drive through this town of OpenStreetMap, not through a scene")
          ->needs(moving)
          ->excludes(scene)
          ->excludes(command.get_option("--osm"));
  add_option(command, "--town-origin", "LAT,LON  (default the middle)", options.town_origin,
             "Origin of the map and start of the drive; give the same to `iog map --origin`")
      ->needs(town);
}

}  // namespace

void add_simulate(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "simulate", "Simulate a drive and write the packets of the car's scanners as a capture");
  const auto options = std::make_shared<SimulateOptions>();
  add_option(*command, "--out", "FILE  (required; without it, --osm writes only the map)",
             options->out, "Capture to write (.pcap)");
  add_option(*command, "--seed", "N  (default 1)", options->seed, "Seed of the random world")
      ->check(not_below_zero());
  add_option(*command, "--seconds", "N  (1 to 600, default 10)", options->seconds,
             "Length of the drive, with 25 frames per second")
      ->check(CLI::Range(1U, Drive::kMaxSeconds));
  CLI::Option* const scene = add_option(*command, "--scene", "NAME  (default city)", options->scene,
                                        "Where the drive goes: " + scene_names())
                                 ->check(known_scenes());
  add_vehicle_options(*command, options->vehicle);
  CLI::Option* const moving =
      command->add_flag("--moving", options->is_moving,
                        "Let everything move during a scan, and write the car's poses");
  command
      ->add_flag("--attitude", options->has_attitude,
                 "Let the car pitch and roll by up to 2 degrees, when it brakes and on bumps")
      ->option_text("(needs --moving)")
      ->needs(moving);
  add_truth_options(*command, *options, moving);
  add_pose_options(*command, *options, moving);
  add_osm_options(*command, options->osm, moving);
  add_town_options(*command, *options, moving, scene);
  command->footer(
      "Without --moving, the world stands still during a scan, and all scanners scan at the same "
      "time. With it, each point is measured from the car's position at that time, each scanner "
      "has its own phase, and messages to UDP port 15010 state the car's pose and its uncertainty. "
      "The true occupancy has the cells of the car's grid, with x to the right and y "
      "up. A cell is 0 if something within the car's height band covers its centre, and 255 "
      "otherwise. docs/drives.md explains --truth-cells, --truth-points and the events of the "
      "scene 'street'. The same options give the same bytes on every machine. Spinning scanners "
      "turn ten times per second, with one return per beam. A car with only such scanners has ten "
      "frames per second.");
  command->callback([command, options] {
    demand_use(
        *command,
        !options->truth.empty() || !options->truth_cells.empty() || !options->truth_points.empty(),
        {"--truth-every"}, "--truth, --truth-cells or --truth-points");
    simulate(*options);
  });
}

}  // namespace iog::tools
