// Which car: one that is known by name, or that of a file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace iog::tools {

// --vehicle, of which the help says `text`, and --vehicle-file. name outlives the command.
void add_vehicle_options(CLI::App& command, std::string& name,
                         const std::string& text = "NAME  (default reference_car)");

// --vehicle-file alone, of commands that know the car by the stream.
CLI::Option* add_vehicle_file_option(CLI::App& command);

// --clock-offset, of commands that read a car's capture or a log of poses.
CLI::Option* add_clock_offset_option(CLI::App& command, double& seconds);

}  // namespace iog::tools
