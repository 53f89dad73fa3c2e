// experiments: repeats what the papers claim, and writes what it finds as CSV.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lab/experiments/side_by_side.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/file.hpp"
#include "tools/program/program.hpp"
#include "tools/program/progress.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

struct Options {
  Input input;
  std::vector<std::string> recordings;
  std::vector<std::string> only;
  std::string out;
};

std::string file_name_of(const Recording& recording) {
  return std::filesystem::path(recording.pcap).filename().string();
}

// Everything that can be wrong with it is found here, before the work begins.
Recording recording_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) {
    throw tools::UsageError("--recording " + text + ": give FILE:VEHICLE");
  }
  Recording recording{.pcap = text.substr(0, colon), .vehicle = text.substr(colon + 1)};
  static_cast<void>(tools::find_vehicle(recording.vehicle));
  static_cast<void>(tools::PcapReader(recording.pcap));
  return recording;
}

std::vector<Recording> recordings_of(const std::vector<std::string>& texts) {
  std::vector<Recording> recordings;
  for (const std::string& text : texts) {
    Recording recording = recording_of(text);
    if (std::ranges::any_of(recordings, [&recording](const Recording& other) {
          return file_name_of(other) == file_name_of(recording);
        })) {
      throw tools::UsageError("--recording " + text + ": two recordings have this name");
    }
    recordings.push_back(std::move(recording));
  }
  return recordings;
}

// names: of experiments, or of pages.
std::vector<Experiment> chosen(const std::vector<std::string>& names) {
  std::vector<Experiment> experiments;
  std::ranges::copy_if(
      all_experiments(), std::back_inserter(experiments), [&names](const Experiment& experiment) {
        return names.empty() || std::ranges::find(names, experiment.name) != names.end() ||
               std::ranges::find(names, experiment.page) != names.end();
      });
  return experiments;
}

void write(const Table& table, const std::string& folder) {
  tools::OutputFile file(folder + "/" + table.name() + ".csv");
  file.write(table.text());
  file.finish();
}

void run(const Options& options) {
  Input input = options.input;
  input.recordings = recordings_of(options.recordings);
  tools::make_folder(options.out);
  const std::vector<Experiment> experiments = chosen(options.only);
  tools::Progress progress("experiments", experiments.size());
  progress.show(0);
  for (const Tables& tables : run_side_by_side(
           experiments, input, [&progress](std::size_t done) { progress.show(done); })) {
    for (const Table& table : tables) {
      write(table, options.out);
    }
  }
}

void add_options(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  tools::add_option(program, "--out", "FOLDER", options->out,
                    "Write a CSV file for each table there")
      ->required();
  tools::add_option(program, "--recording", "FILE:VEHICLE", options->recordings,
                    "A capture and its vehicle, for what only real scans show; may be repeated");
  tools::add_option(program, "--seed", "N  (default 1)", options->input.seed,
                    "The simulated drive's seed")
      ->check(CLI::NonNegativeNumber);
  tools::add_option(program, "--seconds", "N  (1 to 600, default 2)", options->input.seconds,
                    "Its length, 25 frames a second")
      ->check(CLI::Range(1U, tools::Drive::kMaxSeconds));
  tools::add_option(program, "--hills", "N  (1 to 12, default 2)", options->input.hills,
                    "Drives of each car through hills")
      ->check(CLI::Range(1U, 12U));
  std::vector<std::string> names;
  std::string list;
  for (const Experiment& experiment : all_experiments()) {
    names.emplace_back(experiment.name);
    names.emplace_back(experiment.page);
    list.append(list.empty() ? "" : ", ").append(experiment.name);
  }
  tools::add_option(program, "--only", "NAME", options->only,
                    "One experiment alone, or those of a page; may be repeated")
      ->check(CLI::IsMember(names));
  program.footer("Experiments: " + list +
                 "\n"
                 "The same seed, length and recordings give the same tables everywhere, but for "
                 "*_on_this_pc.csv.\n"
                 "lab/run runs all of them and writes the pages.");
  program.callback([options] { run(*options); });
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  CLI::App program("Repeat what the papers claim and write what is found as CSV", "experiments");
  iog::lab::add_options(program);
  return iog::tools::run_program(program, argc, argv);
}
