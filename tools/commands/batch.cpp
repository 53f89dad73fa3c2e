// iog batch: the results of many recordings, each by a process of its own.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "tools/batch/children.hpp"
#include "tools/batch/recordings.hpp"
#include "tools/batch/summary.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/map/block_file.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/progress.hpp"
#include "tools/program/table.hpp"
#include "tools/vehicles/unused_band.hpp"
#include "tools/vehicles/upward_mount.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

struct BatchOptions {
  std::string recordings;
  std::string vehicle = kDefaultVehicle;
  std::string car_file;
  std::string out;
  std::size_t processes = 1;
  std::vector<std::string> of_fuse;  // handed to each `iog fuse`
};

std::string path_of_kept_car(const BatchOptions& options) {
  return options.out + '/' + std::filesystem::path(options.car_file).filename().string();
}

// What a batch writes beside its table may be somebody else's in a folder without a batch.
void demand_own_folder(const BatchOptions& options) {
  std::error_code error;
  const auto is_there = [&](const std::string& path) {
    return std::filesystem::exists(path, error);
  };
  if (const std::string table = options.out + "/summary.csv";
      (is_there(table) && std::filesystem::file_size(table, error) > 0) ||
      has_settings_of_batch(options.out)) {
    return;
  }
  std::vector<std::string> written{options.out + "/batch.txt", options.out + "/running"};
  if (const std::string kept = path_of_kept_car(options);
      !options.car_file.empty() && is_there(kept) &&
      read_file(kept) != read_file(options.car_file)) {
    written.push_back(kept);
  }
  const auto found = std::ranges::find_if(written, is_there);
  if (found != written.end()) {
    throw UsageError(*found +
                     ": iog batch did not write this, and would replace it; give another "
                     "--out");
  }
}

// Files of processes, also of a batch that was killed; what else is there stays.
void remove_work(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const std::string ending =
        name.substr(std::min(name.find_first_not_of("0123456789"), name.size()));
    if (ending != name && (ending == ".out" || ending == ".err" || ending.starts_with(".facts"))) {
      files.push_back(entry.path());
    }
  }
  files.emplace_back(folder);
  for (const std::filesystem::path& path : files) {
    std::error_code not_empty;
    std::filesystem::remove(path, not_empty);
  }
}

// The car's file as it is now: every recording gets the same one, whoever edits it meanwhile.
std::string kept_car(const BatchOptions& options) {
  if (options.car_file.empty()) {
    return {};
  }
  const std::filesystem::path given = options.car_file;
  const std::string kept = path_of_kept_car(options);
  std::error_code error;
  if (!std::filesystem::equivalent(given, kept, error)) {
    OutputFile file(kept);
    file.write(read_file(options.car_file));
    file.finish();
  }
  return kept;
}

std::string settings_of(const BatchOptions& options, const std::string& version) {
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  return version + "\ncar " + std::string(car.vehicle->name) + ' ' + hex(car.vehicle->id) +
         "\noptions " + joined(options.of_fuse, " ") + '\n';
}

// Why it failed, in its own last words: "iog: drive.pcap: cannot be read".
std::string reason_of(const Children::Ended& ended, const std::string& said,
                      const std::string& path) {
  std::string words;
  for (const std::string& line : read_lines(said)) {
    words = line.empty() || line.starts_with("Run with --help") ? words : line;
  }
  for (const std::string& prefix : {std::string("iog: "), path + ": "}) {
    words.erase(0, words.starts_with(prefix) ? prefix.size() : 0);
  }
  if (ended.how.empty()) {
    return words.empty() ? "ended with status " + std::to_string(ended.status) : words;
  }
  return ended.how + (words.empty() ? "" : ": " + words);
}

// Rows of the table of `iog fuse` that a user has to see: on the input, those in capitals, and that
// no packet has a place.
std::string remarks_of(const std::string& table) {
  std::string remarks;
  bool is_of_input = true;
  for (const std::string& line : read_lines(table)) {
    std::string words = line;
    if (const std::size_t end = line.find("  "); end != std::string::npos) {
      words = line.substr(0, end) + ": " + line.substr(line.find_first_not_of(' ', end));
    }
    is_of_input = is_of_input && !line.starts_with("frames ");
    const bool is_loud =
        line.size() > 1 && std::isupper(line[0]) != 0 && std::isupper(line[1]) != 0;
    const bool is_of_none =
        words.starts_with("packets placed: 0,") || words.starts_with("poses: none:");
    if (!is_loud && !is_of_none && (!is_of_input || line.starts_with("packets "))) {
      continue;
    }
    remarks += (remarks.empty() ? "" : "; ") + words;
  }
  return remarks;
}

Facts read_facts(const std::string& path) {
  Facts facts;
  for (const std::string& line : read_lines(path)) {
    const std::size_t end = line.find('=');
    facts.emplace_back(line.substr(0, end), line.substr(end + 1));
  }
  return facts;
}

// A wrong option ends the whole batch, instead of failing each recording.
void check_options(const BatchOptions& options) {
  CLI::App program("", "iog");
  add_fuse(program);
  program.get_subcommand("fuse")->callback({});
  std::vector<std::string> words{"fuse", "--pcap", "drive.pcap", "--poses", "drive.poses.csv"};
  words.insert(words.end(), options.of_fuse.begin(), options.of_fuse.end());
  std::ranges::reverse(words);
  program.parse(words);
}

double seconds_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

class Batch {
 public:
  Batch(const BatchOptions& options, const std::string& version)
      : options_(&options),
        all_(recordings_of(options.recordings)),
        summary_(options.out, settings_of(options, version)),
        car_(kept_car(options)),
        work_(options.out + "/running") {
    known_ =
        std::erase_if(all_, [&](const ListedCapture& each) { return summary_.has(each.name); });
    make_folder(work_);
  }

  void run() {
    const auto begin = std::chrono::steady_clock::now();
    Children children(work_, options_->processes);
    Progress progress("recordings", all_.size());
    for (const ListedCapture& each : all_) {
      bytes_ += each.bytes;
    }
    while (!was_interrupted() && (next_ < all_.size() || children.are_running())) {
      while (next_ < all_.size() && children.free_place()) {
        start(children, *children.free_place());
      }
      if (!children.are_running()) {
        break;  // the last ones were refused
      }
      if (const auto ended = children.wait()) {
        take(*ended, children);
        progress.show(done_, bytes_ > 0 ? std::optional(static_cast<double>(bytes_done_) /
                                                        static_cast<double>(bytes_))
                                        : std::nullopt);
      }
    }
    wall_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  void report() const {
    remove_work(work_);
    const std::string table = options_->out + "/summary.csv";
    const std::size_t left = all_.size() - done_;
    const double all_s = std::max(wall_s_, 0.01) * static_cast<double>(options_->processes);
    const auto busy = static_cast<int>(100 * seconds_of_children() / all_s);
    std::cout << row("recordings", std::to_string(done_) + " now, " + std::to_string(known_) +
                                       " before, " + std::to_string(left) + " left")
              << row("with remarks", std::to_string(with_remarks_) + " now")
              << row("failed", std::to_string(summary_.failed()))
              << row("processes", std::to_string(options_->processes) + ", busy " +
                                      std::to_string(busy) + " % of " +
                                      std::to_string(static_cast<int>(wall_s_)) + " s")
              << row("table", table);
    if (left > 0) {
      throw CheckFailed("interrupted: the same command goes on with the " + std::to_string(left) +
                        " recordings that are left");
    }
    if (summary_.failed() > 0) {
      throw CheckFailed(std::to_string(summary_.failed()) + " of " +
                        std::to_string(done_ + known_) +
                        " recordings failed; the column reason of " + table + " says why");
    }
  }

 private:
  void start(Children& children, std::size_t place) {
    const ListedCapture& recording = all_[next_];
    if (!recording.refusal.empty()) {
      ++next_;
      add({.name = recording.name, .reason = recording.refusal}, recording);
      return;
    }
    std::vector<std::string> words{
        "iog",    "fuse",        "--quiet", "--summary", children.file(place, ".facts"),
        "--pcap", recording.path};
    const std::vector<std::string> car{car_.empty() ? "--vehicle" : "--vehicle-file",
                                       car_.empty() ? options_->vehicle : car_};
    words.insert(words.end(), car.begin(), car.end());
    if (!recording.poses.empty()) {
      words.insert(words.end(), {"--poses", recording.poses});
    }
    words.insert(words.end(), options_->of_fuse.begin(), options_->of_fuse.end());
    children.start(place, next_++, std::move(words));
  }

  void take(const Children::Ended& ended, const Children& children) {
    const ListedCapture& recording = all_[ended.work];
    Outcome outcome{.name = recording.name, .seconds = ended.seconds};
    if (ended.how.empty() && ended.status == kDone) {
      outcome.facts = read_facts(children.file(ended.place, ".facts"));
      outcome.remarks = remarks_of(children.file(ended.place, ".out"));
    } else {
      outcome.reason = reason_of(ended, children.file(ended.place, ".err"), recording.path);
    }
    add(outcome, recording);
  }

  void add(const Outcome& outcome, const ListedCapture& recording) {
    if (!outcome.reason.empty()) {
      std::cerr << (isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "")
                << "iog: " << printable(recording.name + ": " + outcome.reason) << '\n';
    }
    summary_.add(outcome);
    ++done_;
    bytes_done_ += recording.bytes;
    with_remarks_ += outcome.remarks.empty() ? 0U : 1U;
  }

  const BatchOptions* options_;
  std::vector<ListedCapture> all_;  // that are not in the summary yet
  Summary summary_;
  std::string car_;   // a file; empty: by name
  std::string work_;  // folder for what the processes write
  std::size_t known_ = 0;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
  std::size_t with_remarks_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t bytes_done_ = 0;
  double wall_s_ = 0;
};

}  // namespace

void add_batch(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "batch", "Run `iog fuse` on many recordings, side by side, into one table");
  const auto options = std::make_shared<BatchOptions>();
  add_option(*command, "RECORDINGS", "FOLDER | LIST_FILE", options->recordings,
             "Folder whose captures are taken, those in folders below among them, or a text "
             "file that lists captures, one a line")
      ->required();
  add_vehicle_options(*command, options->vehicle);
  add_option(*command, "--out", "FOLDER", options->out,
             "Folder for summary.csv, one row per recording")
      ->required();
  const long online = sysconf(_SC_NPROCESSORS_ONLN);
  options->processes = static_cast<std::size_t>(std::max(online, 1L));
  add_option(*command, "-j,--jobs", "N  (1 to 1024, default one per processor)", options->processes,
             "Processes at a time")
      ->check(CLI::Range(1, 1024));
  struct Handed {
    const char* name;
    const char* text;
    int words;
  };
  for (const auto& [name, text, words] : {Handed{"--rule", "hits_win | bayes", 1},
                                          {"--map", "FILE.iogmap", 1},
                                          {"--poses-mount", "X Y YAW", 3},
                                          {"--poses-sigma", "MM MRAD", 2},
                                          {"--clock-offset", "SECONDS | auto", 1}}) {
    command
        ->add_option_function<std::vector<std::string>>(
            name,
            [options, name = name](const std::vector<std::string>& values) {
              options->of_fuse.emplace_back(name);
              options->of_fuse.insert(options->of_fuse.end(), values.begin(), values.end());
              if (name == std::string_view("--map")) {  // from another folder it is another file
                std::string& path = options->of_fuse.back();
                path = std::filesystem::absolute(path).lexically_normal().string();
                static_cast<void>(read_block(path));
              }
            },
            "As of `iog fuse`, for each recording")
        ->option_text(text)
        ->expected(words);
  }
  command->footer(
      "Captures are .pcap and .pcapng, also .gz or .zst. Paths in a list are relative to the list. "
      "Poses come from the log beside NAME.pcap that is called NAME.poses.csv (or .nmea, .ubx, "
      ".txt, .tum, .mcap, .db3, or a folder NAME.poses), and else from the capture. A recording "
      "that fails has a row with its reason, and the others go on. Exit status 1 if one failed. "
      "The same command continues an interrupted batch. Remove a row to compute its recording "
      "again. docs/batch.md lists the columns.");
  command->callback([&program, options, command] {
    if (const CLI::Option* const file = command->get_option("--vehicle-file"); !file->empty()) {
      options->car_file = file->results().front();
    }
    check_options(*options);
    const CatalogueEntry& car = find_vehicle(options->vehicle);
    std::cerr << warning_of_upward_mounts(car) << warning_of_unused_band(car);
    demand_own_folder(*options);
    catch_interrupts();
    Batch batch(*options, program.version());
    batch.run();
    batch.report();
  });
}

}  // namespace iog::tools
