#include "tools/commands/output_options.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>

#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/letter_case.hpp"
#include "tools/program/unknown_word.hpp"

namespace iog::tools {
namespace {

namespace files = std::filesystem;

constexpr std::array<std::string_view, 9> kOutputs{"out",     "out-raw",     "classes-png",
                                                   "png",     "truth-cells", "truth-points",
                                                   "summary", "hashes",      "classes-hashes"};

// --stream and --osm are inputs of other commands.
bool is_output(const CLI::App& command, const CLI::Option& option) {
  const std::string name = option.get_single_name();
  return std::ranges::find(kOutputs, name) != kOutputs.end() ||
         (name == "stream" && command.get_name() != "record") ||
         ((name == "osm" || name == "truth") && command.get_name() == "simulate");
}

// Whether the command makes a folder of it, with those above it.
bool is_folder(const CLI::App& command, const CLI::Option& option, const files::path& path) {
  constexpr std::array<std::string_view, 3> kDrawing{"fuse", "receive", "batch"};
  const std::string name = command.get_name();
  const bool is_recorded = path.extension() == ".mcap" || path.extension() == ".pcap";
  return option.get_single_name() == "truth" ||
         (option.get_single_name() == "out" &&
          (name == "record" ? !is_recorded : std::ranges::find(kDrawing, name) != kDrawing.end()));
}

files::path place_of(const std::string& path) {
  std::error_code error;
  return files::weakly_canonical(files::absolute(path), error);
}

// The folders that the command makes, with those above them.
std::set<files::path> made_folders(const CLI::App& command) {
  std::set<files::path> made;
  for (const CLI::Option* const option : tools::options_of(command)) {
    for (const std::string& path : option->results()) {
      if (is_output(command, *option) && is_folder(command, *option, path)) {
        for (files::path its = place_of(path + "/."); its != its.root_path();
             its = its.parent_path()) {
          made.insert(its);
        }
      }
    }
  }
  return made;
}

// Every output is made beside its place at first (OutputPlace), except devices and pipes. made: the
// folders that will be there.
void demand_place(const std::string& path, const std::set<files::path>& made) {
  std::error_code error;
  const bool is_folder = files::is_directory(path, error);
  if (files::exists(path, error) && !files::is_regular_file(path, error) && !is_folder) {
    return;
  }
  const files::path parent = place_of(path).parent_path();
  const bool is_made = made.contains(parent) && !files::exists(parent, error);
  errno = is_folder ? EISDIR : 0;
  if (is_folder || (!is_made && access((parent / ".").c_str(), W_OK | X_OK) != 0)) {
    throw file_error(path, "cannot be written");
  }
}

// The ending that the option's description names, "(.pcap)"; empty if it names none.
std::string ending_of(const CLI::Option& option) {
  const std::string& text = option.get_description();
  const std::size_t begin = text.find("(.");
  return begin == std::string::npos ? ""
                                    : text.substr(begin + 1, text.find(')', begin) - begin - 1);
}

// Rejects names that end as another format does: other programs, and iog, would misread the file.
void demand_ending(const std::string& path, const std::string& its) {
  constexpr std::array<std::string_view, 14> kOthers{
      ".pcap", ".pcapng", ".csv",  ".mcap",   ".db3", ".gz",   ".zst",
      ".png",  ".json",   ".toml", ".iogmap", ".tum", ".nmea", ".ubx"};
  const std::string ending = in_lower_case(files::path(path).extension().string());
  if (!its.empty() && ending != its && std::ranges::find(kOthers, ending) != kOthers.end()) {
    throw UsageError(path + ": the output is a " + its + " file: use a name that ends in " + its);
  }
}

bool is_file(const std::string& path, const std::string& output) {
  std::error_code error;
  return files::equivalent(path, output, error) && files::is_regular_file(output, error);
}

// Of a folder every file belongs to the input, except a capture: nobody reads those in a folder.
bool is_in_folder(const std::string& folder, const std::string& output) {
  std::error_code error;
  if (!files::is_directory(folder, error) || !files::is_regular_file(output, error)) {
    return false;
  }
  const files::path inside = files::canonical(output, error);
  const files::path outside = files::canonical(folder, error);
  return inside.extension() != ".pcap" &&
         std::ranges::mismatch(outside, inside).in1 == outside.end();
}

// An input is FILE, FILE:SENSOR or FILE:/topic.
bool is_read(const std::string& input, const std::string& output) {
  const std::string path = input.substr(0, input.rfind(':'));
  return is_file(input, output) || is_file(path, output) || is_in_folder(input, output) ||
         is_in_folder(path, output);
}

}  // namespace

void check_outputs(const CLI::App& command) {
  std::set<files::path> places;
  std::map<std::string, std::string> outputs;  // with the ending that each should have
  std::set<std::string> inputs;
  const std::set<files::path> made = made_folders(command);
  for (const CLI::Option* const option : options_of(command)) {
    for (const std::string& path : option->results()) {
      if (!is_output(command, *option)) {
        inputs.insert(path);
        continue;
      }
      const bool makes_folder = is_folder(command, *option, path);
      outputs.emplace(path, makes_folder ? "" : ending_of(*option));
      if (path != "-" && !makes_folder) {
        demand_place(path, made);
      }
      if (path != "-" && !places.insert(place_of(path)).second) {
        throw UsageError(option->get_name() + " " + path + ": given twice");
      }
    }
  }
  for (const auto& [output, ending] : outputs) {
    const auto reads = [&, &its = output](const std::string& input) { return is_read(input, its); };
    if (std::ranges::any_of(inputs, reads)) {
      throw UsageError(output + ": this file is read: give another output");
    }
    demand_ending(output, ending);
  }
}

}  // namespace iog::tools
