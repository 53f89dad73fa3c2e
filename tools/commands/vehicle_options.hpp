// Which car: one that is known by name, or that of a file.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tools/identity/car_capture.hpp"

namespace iog::tools {

// Tell the shell which names it may offer. They check nothing, because find_vehicle() and
// find_scene() do.
[[nodiscard]] CLI::Validator known_vehicles();
[[nodiscard]] CLI::Validator known_scenes();

// --vehicle, of which the help says `text`, and --vehicle-file. name outlives the command.
void add_vehicle_options(CLI::App& command, std::string& name,
                         const std::string& text = "NAME  (default reference_car)");

// --vehicle-file alone, of commands that know the car by the stream.
CLI::Option* add_vehicle_file_option(CLI::App& command);

// --clock-offset of a log of poses.
CLI::Option* add_clock_offset_option(CLI::App& command, std::optional<double>& seconds);

// --poses, of which the help says `text`, --poses-mount and --poses-sigma.
CLI::Option* add_log_options(CLI::App& command, DriveFiles& drive, const std::string& text);

inline constexpr const char* kCapturesHelp =
    "Capture to read (.pcap, .pcapng; also .gz or .zst); several are merged by time";

// --pcap, and with it the options of a log and --clock-offset. `names` may add a place on the
// command line, `command` may be a group of `all`.
CLI::Option* add_drive_options(CLI::App& all, CLI::App& command, DriveFiles& drive,
                               const std::string& text, const std::string& names = "--pcap");

}  // namespace iog::tools
