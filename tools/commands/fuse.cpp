// iog fuse: the grids of a capture, by the target's own code, without a target.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pose/message.hpp"
#include "tools/commands/next_steps.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/picture/class_picture.hpp"
#include "tools/formats/picture/frame_writer.hpp"
#include "tools/frames/chosen_frame.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/fuse/repeated_run.hpp"
#include "tools/fuse/stream_recorder.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/identity/car_capture.hpp"
#include "tools/identity/sensor_watch.hpp"
#include "tools/map/block_file.hpp"
#include "tools/mount/mount_watch.hpp"
#include "tools/odometry/motion_check.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/number_checks.hpp"
#include "tools/program/option_use.hpp"
#include "tools/program/progress.hpp"
#include "tools/receive/class_record.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/record/stream_file.hpp"
#include "tools/vehicles/car_words.hpp"
#include "tools/vehicles/unused_band.hpp"
#include "tools/vehicles/upward_mount.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {
namespace {

struct FuseOptions {
  DriveFiles drive;
  std::string vehicle = kDefaultVehicle;
  std::optional<std::uint64_t> frame;
  std::string out_raw;
  std::string hashes;
  std::string summary;
  std::string rule;
  std::string stream;
  std::uint32_t run_number = OfflineTarget::kRunNumber;
  PictureOptions pictures;
  std::string classes_hashes;
  std::string classes_png;
  std::string map;
  std::string as_received;
};

vehicle::Vehicle vehicle_with_rule(const CatalogueEntry& car, const std::string& rule) {
  vehicle::Vehicle vehicle = *car.vehicle;
  if (!rule.empty()) {
    vehicle.rule = rule == "bayes" ? vehicle::FusionRule::kBayes : vehicle::FusionRule::kHitsWin;
  }
  return vehicle;
}

std::string words_of_missing(std::uint64_t frame, std::size_t count) {
  return "no frame " + std::to_string(frame) + "; the capture has " + std::to_string(count) +
         " frames with evidence";
}

// What is asked for has to be among the car's grids.
void demand_grids(const FuseOptions& options, const vehicle::Vehicle& car) {
  const std::string its_grids =
      std::string(car.name) + " asks for grids = \"" + std::string(word_of(car.grids)) + '"';
  if (!options.classes_png.empty() && !vehicle::have_classes(car.grids)) {
    throw UsageError("--classes-png: " + its_grids + ", which have no classes");
  }
  if (!options.out_raw.empty() && !vehicle::have_indexes(car.grids)) {
    throw UsageError("--out-raw: " + its_grids + ", which have no indexes");
  }
}

bool writes_frame(const FuseOptions& options) {
  return !options.out_raw.empty() || !options.pictures.folder.empty();
}

void demand_frame(const FuseOptions& options, const ChosenFrame& chosen, std::size_t count) {
  if (writes_frame(options) && options.frame && !chosen.get()) {
    throw UsageError(words_of_missing(*options.frame, count));
  }
}

// What the packets of a drive say of the car's file.
class Signs {
 public:
  explicit Signs(const CatalogueEntry& car)
      : car_(&car), sensors_(car), mount_(car), motion_(car) {}

  void take(const CapturedDatagram& datagram) {
    identity_.add(datagram);
    sensors_.take(datagram);
    mount_.take(datagram);
    motion_.take(datagram);
    const std::uint16_t port = datagram.destination.port;
    has_poses_ = has_poses_ || is_pose_port(*car_, port);
    if (!has_poses_ && !takes_port(*car_, port) &&
        pose::decode(datagram.payload).fate == pose::Fate::kUsed) {
      port_of_poses_ = port;
    }
  }

  [[nodiscard]] std::string words_of_other_car() const { return identity_.words(*car_); }
  [[nodiscard]] std::string rows(const RunStatistics& statistics, const CarCapture& capture) {
    const std::string motion = motion_.words();
    const std::string crowd = capture.words_of_crowd();
    std::string lost;
    for (const std::string& words : capture.words_of_lost()) {
      lost += row("LOST?", words);
    }
    const std::string wrong_port =
        words_of_other_car().empty() ? identity_.words_of_wrong_port(*car_) : "";
    return mount_.rows() + row_if(!crowd.empty(), "SENSOR?", crowd) + lost +
           row_if(!wrong_port.empty(), "PORT?", wrong_port) + row_of_pose_port() +
           sensors_.rows_of_silence() + sensors_.rows_of_turns() +
           sensors_.rows_of_late(statistics.packets_fused(), statistics.packets_late()) +
           row_if(!motion.empty(), "POSES?", motion + "; `iog odometry --poses` compares them");
  }

 private:
  [[nodiscard]] std::string row_of_pose_port() const {
    const vehicle::Vehicle& vehicle = *car_->vehicle;
    return row_if(!has_poses_ && port_of_poses_ > 0 && vehicle::have_classes(vehicle.grids),
                  "PORT?",
                  "no pose comes to UDP port " + std::to_string(vehicle.poses.udp_port) +
                      ", but poses come to " + std::to_string(port_of_poses_) +
                      ": check udp_port of `poses` in the car file");
  }

  const CatalogueEntry* car_;
  CaptureIdentity identity_;
  SensorWatch sensors_;
  MountWatch mount_;
  MotionWatch motion_;
  bool has_poses_ = false;
  std::uint16_t port_of_poses_ = 0;  // of a pose that the car does not take
};

// What the target has no port for is left out.
std::uint64_t feed(CarCapture& capture, const CatalogueEntry& car, OfflineTarget& target,
                   Signs& signs) {
  Progress progress("packets");
  std::uint64_t other_ports = 0;
  while (const std::optional<CapturedDatagram> datagram = capture.next()) {
    signs.take(*datagram);
    if (takes_port(car, datagram->destination.port)) {
      static_cast<void>(target.take(*datagram));
    } else {
      ++other_ports;
    }
    progress.show(capture.files().datagrams(), capture.files().part_read());
  }
  target.finish();
  return other_ports;
}

// Each datagram when the target of a recorded stream took it.
std::uint64_t feed_as_received(const std::string& stream, CarCapture& capture,
                               const CatalogueEntry& car, OfflineTarget& target, Signs& signs) {
  RepeatedRun run(target.vehicle());
  // What of its last frames is not whole is none.
  FrameAssembler received([&run](GridFrame&& frame) { run.add(frame); });
  StreamFile file(stream);
  while (const std::optional<CapturedDatagram> datagram = file.next()) {
    received.take(datagram->payload);
  }
  std::uint64_t other_ports = 0;
  while (std::optional<CapturedDatagram> datagram = capture.next()) {
    signs.take(*datagram);
    if (takes_port(car, datagram->destination.port)) {
      run.add(*std::move(datagram));
    } else {
      ++other_ports;
    }
  }
  run.play(target);
  return other_ports;
}

// The classes that are drawn: of the frame that was asked for, or of the last one with a place.
class ClassDrawing {
 public:
  explicit ClassDrawing(const FuseOptions& options) : options_(&options) {}

  void offer(const GridFrame& frame) {
    if (options_->classes_png.empty() || !frame.classes || !frame.header.has_evidence()) {
      return;
    }
    const bool is_chosen = options_->frame ? frame.evidence_number == *options_->frame
                                           : frame.classes->window.slices > 0;
    if (is_chosen) {
      title_ = title_of(frame);
      classes_ = frame.classes;
    }
  }

  // UsageError or CheckFailed if there is nothing to draw. clocks: how those of poses and packets
  // differ.
  void demand(const RunStatistics& statistics, std::uint16_t pose_port,
              const std::string& clocks) const {
    if (options_->classes_png.empty() || classes_) {
      return;
    }
    if (options_->frame) {
      throw UsageError(words_of_missing(*options_->frame, statistics.records().size()));
    }
    throw CheckFailed(
        "no frame to draw has a place: " +
        (clocks.empty() ? statistics.classes().why_nothing_placed(pose_port) : clocks));
  }

  void write() const {
    if (classes_) {
      picture_of(*classes_, title_, options_->pictures.scale).write_png(options_->classes_png);
    }
  }

 private:
  const FuseOptions* options_;
  FrameTitle title_;
  std::optional<ClassGrid> classes_;
};

void print_input(const CarCapture& capture, std::uint64_t other_ports) {
  std::cout << row("packets", std::to_string(capture.files().datagrams() - other_ports) +
                                  " for the vehicle's ports, " + std::to_string(other_ports) +
                                  " for others");
  const auto print = [](const char* name, const std::string& which, const std::string& words) {
    std::cout << (words.empty() ? "" : row(name, which + words));
  };
  for (const CaptureSet::File& file : capture.files().files()) {
    const std::string which = capture.files().files().size() > 1 ? file.path + ": " : "";
    print("not looked at", which, describe_skipped(file.reader->counts()));
    print("capture", which, file.reader->trouble());
    print("capture", which, file.reader->clock_words());
  }
  for (const std::string& words : capture.remarks()) {
    print("poses", "", words);
  }
  print("capture", "", capture.clock_words());
}

void write_tables(const FuseOptions& options, const RunStatistics& statistics) {
  if (!options.summary.empty()) {
    write_facts(options.summary, statistics.facts());
  }
  if (!options.hashes.empty()) {
    write_records(options.hashes, statistics.records());
  }
  if (!options.classes_hashes.empty()) {
    write_class_records(options.classes_hashes, statistics.classes().records());
  }
}

void fuse(const FuseOptions& options) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  const vehicle::Vehicle vehicle = vehicle_with_rule(car, options.rule);
  demand_grids(options, vehicle);
  std::cerr << warning_of_upward_mounts(car) << warning_of_unused_band(car);
  demand_fit(options.drive.captures, car);
  CarCapture capture(options.drive, car);
  RunStatistics statistics;
  ChosenFrame chosen(options.frame);
  FrameWriter pictures(options.pictures);
  ClassDrawing drawing(options);
  Signs signs(car);
  FrameAssembler assembler([&](GridFrame&& frame) {
    statistics.add(frame);
    pictures.offer(frame);
    drawing.offer(frame);
    chosen.offer(std::move(frame));
  });
  std::optional<StreamRecorder> recorder;
  if (options.stream.empty()) {
    assembler.trust_raw();
  } else {
    recorder.emplace(options.stream);
  }
  const auto on_message = [&](std::span<const std::byte> message) {
    assembler.take(message);
    if (recorder) {
      recorder->take(message);
    }
  };
  const auto target =
      std::make_unique<OfflineTarget>(vehicle, on_message, Stopwatch::kRuns, options.run_number,
                                      recorder ? app::Coding::kShortest : app::Coding::kRaw);
  if (!options.map.empty()) {
    target->begin_with_map(read_block(options.map));
  }
  const std::uint64_t other_ports =
      options.as_received.empty()
          ? feed(capture, car, *target, signs)
          : feed_as_received(options.as_received, capture, car, *target, signs);
  assembler.finish();

  print_input(capture, other_ports);
  const std::string other_car = signs.words_of_other_car();
  std::cout << row_if(!other_car.empty(), "OTHER VEHICLE?", other_car) << statistics.table(false)
            << signs.rows(statistics, capture);
  if (statistics.records().empty()) {
    throw CheckFailed(options.drive.name() + ": no frame has evidence: what came to the ports of " +
                      options.vehicle + " holds no scan of its sensors; `iog info " +
                      options.drive.captures[0] + "` says what it is");
  }
  demand_frame(options, chosen, statistics.records().size());
  drawing.demand(statistics, vehicle.poses.udp_port, capture.time_words());
  if (recorder) {
    recorder->finish();
  }
  write_tables(options, statistics);
  drawing.write();
  if (writes_frame(options) && chosen.get()) {
    const GridFrame& frame = *chosen.get();
    pictures.write_last(frame);
    if (!options.out_raw.empty()) {
      OutputFile file(options.out_raw);
      const std::vector<index::OccupancyIndex> cells = cells_in_grid(frame);
      file.write(std::as_bytes(std::span(cells)));
      file.finish();
    }
  }
}

}  // namespace

void add_fuse(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "fuse", "Compute the grids of a capture on this PC, with the target's own code");
  const auto options = std::make_shared<FuseOptions>();
  add_drive_options(*command, *command, options->drive, kCapturesHelp)->required();
  add_vehicle_options(*command, options->vehicle);
  add_option(*command, "--frame", "N  (default the last of whole scans)", options->frame,
             "Frame to write; 0 is the first frame with evidence")
      ->check(not_below_zero());
  add_option(*command, "--out-raw", "FILE", options->out_raw,
             "Write the occupancy indexes of this frame as bytes");
  add_picture_options(*command, options->pictures);
  add_option(*command, "--rule", "hits_win | bayes", options->rule,
             "Fusion rule to use instead of the car's")
      ->check(CLI::IsMember({"hits_win", "bayes"}));
  add_option(*command, "--hashes", "FILE", options->hashes,
             "Write one line per frame with evidence");
  add_option(*command, "--summary", "FILE", options->summary,
             "Write the numbers of the table as key=value lines");
  add_option(*command, "--stream", "FILE", options->stream,
             "Write the messages that the target would send, as a capture (.pcap)");
  add_option(*command, "--run-number", "N  (default 1)", options->run_number,
             "Run number in these messages, as if the target had restarted")
      ->needs("--stream");
  add_option(*command, "--classes-hashes", "FILE", options->classes_hashes,
             "Write one line per frame of the perception grid; needs poses");
  add_option(*command, "--classes-png", "FILE", options->classes_png,
             "Draw the perception grid of this frame, or of the last frame with a pose, as a "
             ".png file");
  add_option(*command, "--as-received", "FILE", options->as_received,
             "Repeat the arrival times of this recorded stream, to reproduce classes of "
             "unsynchronised sensors");
  add_option(*command, "--map", "FILE", options->map,
             "City map that the target has from the start (.iogmap)");
  command->footer(
      "fuse processes the capture as if `iog replay` sent it. It assigns packets to sensors by "
      "destination port. After a packet from a sensor's source_ipv4, it skips the port's packets "
      "from other addresses. Time is that of the capture. A pause counts as at most 1 s.\n"
      "--out-raw: columns x rows int8, row by row from the lowest y. --hashes: number, complete "
      "and partial sensors (hex), points used, tiles, grid CRC; the run hash is the CRC-32 of "
      "these CRCs.\n"
      "--classes-hashes: number, time on the poses' clock, slices and packets with a pose, packets "
      "without one, causes (hex, docs/spec.md 3.9), the window's corner in tiles, tiles, CRC of "
      "the classes, and the frames without evidence in which the window's time advanced, since the "
      "first line.\n" +
      std::string(kPictureFooter));
  const auto is_quiet = std::make_shared<bool>(false);
  command->add_flag("--quiet", *is_quiet, "Do not suggest commands for this drive on a terminal");
  command->callback([command, options, is_quiet] {
    const bool has_folder = !options->pictures.folder.empty();
    const bool draws = has_folder || !options->classes_png.empty();
    demand_use(*command, has_folder, {"--every"}, "--out FOLDER");
    demand_use(*command, draws, {"--scale", "--radius"}, "--out FOLDER or --classes-png FILE");
    demand_use(*command, draws || !options->out_raw.empty(), {"--frame"}, "--out-raw or a picture");
    fuse(*options);
    std::cout << (*is_quiet ? "" : rows_of_next_steps(*command));
  });
}

}  // namespace iog::tools
