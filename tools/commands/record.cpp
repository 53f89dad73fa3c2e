// iog record: a stream into files that other tools open.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/number_checks.hpp"
#include "tools/program/option_use.hpp"
#include "tools/record/mcap_recording.hpp"
#include "tools/record/pcap_recording.hpp"
#include "tools/record/picture_recording.hpp"
#include "tools/record/sources.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

std::vector<std::string> all_topics() { return {kAllTopics.begin(), kAllTopics.end()}; }

// Without scan points, which a stream does not have: so what is made of a capture can be made of
// its recording again.
std::vector<std::string> usual_topics() {
  std::vector<std::string> topics = all_topics();
  std::erase(topics, kPointsTopic);
  return topics;
}

struct RecordOptions {
  LiveSource live;
  DriveFiles drive;
  std::string vehicle = kDefaultVehicle;
  std::string stream;
  std::vector<std::string> out;
  std::vector<std::string> topics = usual_topics();
  bool has_points = false;
  bool is_uncompressed = false;
  std::string stamp = "target";
  std::string map;
  PictureOptions pictures{.folder = {}, .every = 1, .scale = {}};
  bool with_maps = false;
};

Stamp stamp_of(const std::string& name) {
  return static_cast<Stamp>(std::ranges::find(kStampNames, name) - kStampNames.begin());
}

// Of one that is not written yet by its name; of anything else that is not a folder, an error.
std::unique_ptr<Recording> recording_of(const std::string& path, const RecordOptions& options) {
  const std::string suffix = std::filesystem::path(path).extension();
  if (suffix == ".mcap") {
    return std::make_unique<McapRecording>(
        path, options.topics,
        options.is_uncompressed ? mcap::Compression::kNone : mcap::Compression::kZstd,
        stamp_of(options.stamp));
  }
  if (suffix == ".pcap") {
    return std::make_unique<PcapRecording>(path);
  }
  if (!suffix.empty() && !std::filesystem::is_directory(path)) {
    throw UsageError("--out " + path + ": give FILE.mcap, FILE.pcap or a folder");
  }
  PictureOptions pictures = options.pictures;
  pictures.folder = path;
  return std::make_unique<PictureRecording>(pictures, options.with_maps);
}

// An option of one kind of output does nothing for another.
void demand_uses(const CLI::App& command, const RecordOptions& options) {
  const auto is = [&](const std::string& suffix) {
    return [suffix](const std::string& path) {
      return std::filesystem::path(path).extension() == suffix;
    };
  };
  const auto is_folder = [&](const std::string& path) {
    return !is(".mcap")(path) && !is(".pcap")(path);
  };
  demand_use(command, std::ranges::any_of(options.out, is(".mcap")),
             {"--topics", "--points", "--uncompressed", "--stamp"}, "--out FILE.mcap");
  if (std::ranges::count(options.topics, kPointsTopic) > 0 && options.drive.captures.empty()) {
    throw UsageError(std::string("--topics ") + std::string(kPointsTopic) + " requires --pcap");
  }
  demand_use(command, std::ranges::any_of(options.out, is_folder),
             {"--every", "--maps", "--scale", "--radius"}, "--out FOLDER");
}

// From wherever it comes. The number of datagrams that were dropped on the way.
std::uint64_t record_from_source(const RecordOptions& options, Recorder& recorder) {
  if (!options.drive.captures.empty()) {
    record_capture(options.drive, options.vehicle, options.map, recorder);
  } else if (!options.stream.empty()) {
    record_stream(options.stream, recorder);
  } else {
    return record_live(options.live, recorder);
  }
  return 0;
}

void record(RecordOptions options) {
  if (options.has_points) {
    options.topics.emplace_back(kPointsTopic);
  }
  if (!options.drive.captures.empty()) {
    demand_fit(options.drive.captures, find_vehicle(options.vehicle));
  }
  std::vector<std::string> paths = options.out;
  std::stable_partition(paths.begin(), paths.end(),
                        [](const std::string& path) {  // files may lie in folders
                          return !std::filesystem::path(path).has_extension();
                        });
  Recorder::Recordings recordings;
  for (const std::string& path : paths) {
    recordings.push_back(recording_of(path, options));
  }
  Recorder recorder(std::move(recordings));
  const std::uint64_t overflow = record_from_source(options, recorder);
  if (recorder.datagrams() == 0) {
    throw CheckFailed("no message of a target came, and nothing is written");
  }
  recorder.finish();
  // With --notify standard output belongs to whoever reads the notes.
  std::ostream& table = options.live.notify ? std::cerr : std::cout;
  table << recorder.census().table();
  for (const auto& [name, count] :
       {std::pair{"messages overflow", overflow}, {"datagrams too long", recorder.too_long()}}) {
    if (count > 0) {
      table << row(name, std::to_string(count));
    }
  }
  for (const std::string& path : options.out) {
    table << row("written", path);
  }
  if (was_interrupted() && !(options.drive.captures.empty() && options.stream.empty())) {
    throw CheckFailed("interrupted: only the first part of the source is recorded");
  }
}

void add_sources(CLI::App& command, RecordOptions& options) {
  auto* const sources = command.add_option_group("source");
  auto* const port = add_option(*sources, "--port", "PORT", options.live.port,
                                "Record the stream that a target sends to this UDP port")
                         ->check(CLI::Range(1, 65'535));
  auto* const pcap = add_drive_options(command, *sources, options.drive,
                                       "Fuse this capture of sensors (.pcap, .pcapng; also .gz or "
                                       ".zst); several are merged by time");
  add_option(*sources, "--stream", "FILE", options.stream,
             "Record from a stream in FILE.pcap or FILE.mcap");
  sources->require_option(1);
  add_vehicle_options(command, options.vehicle, "NAME  (with --pcap; default reference_car)");
  add_option(command, "--map", "FILE  (with --pcap)", options.map,
             "City map that the target has from the start (.iogmap)")
      ->needs(pcap);
  add_option(command, "--bind", "ADDRESS  (with --port; default 127.0.0.1)", options.live.bind,
             "IPv4 address to receive on")
      ->needs(port);
  add_option(command, "--frames", "N  (with --port)", options.live.frames,
             "End after this number of frames with evidence")
      ->check(not_below_zero())
      ->needs(port);
  add_option(command, "--idle-timeout", "SECONDS  (with --port)", options.live.idle_timeout_s,
             "End after this time without a frame with evidence")
      ->check(above_zero())
      ->needs(port);
  command
      .add_flag("--notify", options.live.notify,
                "Print `listening`, then `frame N` or `nothing taken` per frame")
      ->needs(port);
}

void add_destinations(CLI::App& command, RecordOptions& options) {
  add_option(command, "--out", "FILE | FOLDER  (required)", options.out,
             "What to write: FILE.mcap, FILE.pcap or a folder of pictures; may be repeated")
      ->required();
  add_option(command, "--topics", "TOPIC,...  (default all but /points)", options.topics,
             "Topics of an MCAP file: " + joined(kAllTopics, ","))
      ->delimiter(',')
      ->check(CLI::IsMember(all_topics()));
  command.add_flag("--points", options.has_points, "Also record scan points on /points")
      ->option_text("(needs --pcap)")
      ->needs(command.get_option("--pcap"));
  command.add_flag("--uncompressed", options.is_uncompressed, "Do not compress MCAP files");
  add_option(command, "--stamp", "target | arrival | poses  (default target)", options.stamp,
             "Clock of the timestamps in an MCAP file: of the target, of this PC, or of the poses")
      ->check(CLI::IsMember({"target", "arrival", "poses"}));
  add_option(command, "--every", "N  (default 1)", options.pictures.every, "Draw every Nth frame")
      ->check(above_zero());
  command.add_flag("--maps", options.with_maps,
                   "Also write map_NNNNNN.pgm and map_NNNNNN.yaml for each picture");
  add_scale_options(command, options.pictures.scale);
}

}  // namespace

void add_record(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "record", "Record grids as MCAP (ROS 2, Foxglove), pictures, maps or the stream itself");
  const auto options = std::make_shared<RecordOptions>();
  add_sources(*command, *options);
  add_destinations(*command, *options);
  command->footer(
      "docs/recordings.md lists the programs that open the files. Ctrl-C ends a recording cleanly. "
      "If record is killed, its MCAP file loses at most the last second. With --pcap and --stream, "
      "the same input gives the same bytes. A folder receives frame_NNNNNN.png for every frame "
      "with evidence, classes_NNNNNN.png if the frame has classes, and the last frame as map.pgm "
      "and map.yaml. Numbered files of an earlier run of iog are removed when the first picture "
      "comes.");
  command->callback([command, options] {
    demand_uses(*command, *options);
    catch_interrupts();
    record(*options);
  });
}

}  // namespace iog::tools
