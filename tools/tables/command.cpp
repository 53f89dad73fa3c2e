// iog tables: what the papers claim beside what is found here.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tools/capture/pcap_reader.hpp"
#include "tools/catalogue/vehicle_catalogue.hpp"
#include "tools/command/exit_status.hpp"
#include "tools/command/file.hpp"
#include "tools/command/progress.hpp"
#include "tools/command/subcommands.hpp"
#include "tools/simulate/drive.hpp"
#include "tools/tables/page.hpp"

namespace iog::tools {
namespace {

struct Options {
  TablesInput input;
  std::vector<std::string> recordings;
  std::string only;
  std::string out;
};

std::string name_of(const Recording& recording) {
  return std::filesystem::path(recording.pcap).filename().string();
}

// Everything that can be wrong with it is found here, before the work begins.
Recording recording_of(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) {
    throw UsageError("--recording " + text + ": give FILE:VEHICLE");
  }
  Recording recording{.pcap = text.substr(0, colon), .vehicle = text.substr(colon + 1)};
  static_cast<void>(find_vehicle(recording.vehicle));
  static_cast<void>(PcapReader(recording.pcap));
  return recording;
}

std::vector<Recording> recordings_of(const std::vector<std::string>& texts) {
  std::vector<Recording> recordings;
  for (const std::string& text : texts) {
    Recording recording = recording_of(text);
    if (std::any_of(recordings.begin(), recordings.end(), [&recording](const Recording& other) {
          return name_of(other) == name_of(recording);
        })) {
      throw UsageError("--recording " + text + ": two recordings have this name on the page");
    }
    recordings.push_back(std::move(recording));
  }
  return recordings;
}

std::span<const NamedSection> chosen_sections(const std::string& only) {
  const std::span<const NamedSection> sections = all_sections();
  const auto chosen =
      std::find_if(sections.begin(), sections.end(),
                   [&only](const NamedSection& section) { return section.name == only; });
  return chosen == sections.end() ? sections : std::span(&*chosen, 1);
}

std::string names_of_sections() {
  std::string names;
  for (const NamedSection& section : all_sections()) {
    names.append(names.empty() ? "" : ", ").append(section.name);
  }
  return names;
}

void tables(const Options& options) {
  TablesInput input = options.input;
  input.recordings = recordings_of(options.recordings);
  if (!options.out.empty()) {
    input.figures = options.out + "/" + kFiguresFolder;
    make_folder(input.figures);
  }
  const std::span<const NamedSection> sections = chosen_sections(options.only);
  Progress progress("sections", sections.size());
  progress.show(0);
  const std::vector<Section> results =
      compute(sections, input, [&progress](std::size_t done) { progress.show(done); });
  const std::string page = page_of(input, results);
  if (options.out.empty()) {
    std::cout << page;
    return;
  }
  const std::string path = options.out + "/results.md";
  OutputFile file(path);
  file.write(page);
  file.finish();
  std::cout << path << ", pictures in " << input.figures << '\n';
}

}  // namespace

void add_tables(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "tables", "Repeat the papers' tables and figures and set them beside the printed ones");
  const auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "Write results.md and results/*.svg, *.png there")
      ->option_text("FOLDER  (else the page goes to stdout)");
  command
      ->add_option("--recording", options->recordings,
                   "A capture and its vehicle, for what only real scans show; may be repeated")
      ->option_text("FILE:VEHICLE");
  command->add_option("--seed", options->input.seed, "The simulated drive's seed")
      ->option_text("N  (default 1)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--seconds", options->input.seconds, "Its length, 25 frames a second")
      ->option_text("N  (1 to 600, default 2)")
      ->check(CLI::Range(1U, Drive::kMaxSeconds));
  std::vector<std::string> names;
  for (const NamedSection& section : all_sections()) {
    names.emplace_back(section.name);
  }
  command->add_option("--only", options->only, "One section alone, by its name below")
      ->option_text("NAME")
      ->check(CLI::IsMember(names));
  command->footer("Sections: " + names_of_sections() +
                  "\n"
                  "Plots need gnuplot (Debian's gnuplot-nox). The same seed, length and recordings "
                  "give the same\n"
                  "page everywhere, but for lines that say \"on this PC\". docs/results.md is made "
                  "by bench/results.");
  command->callback([options] { tables(*options); });
}

}  // namespace iog::tools
