// iog info: what is in a file, whatever it is.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/info/file_summary.hpp"

namespace iog::tools {

void add_info(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "info", "Describe a capture, a recording, a bag, a map or a folder of pictures");
  const auto path = std::make_shared<std::string>();
  command->add_option("FILE", *path, "File or folder to read")->option_text(" ")->required();
  // `iog info --pcap FILE` is how other commands name a capture; the word alone says nothing here.
  command->add_flag("--pcap")->group("");
  add_vehicle_file_option(*command);
  command->footer(
      "info reads captures (.pcap, .pcapng) of sensors or of a target's stream, MCAP files, bags "
      "of ROS 2, maps of ROS map_server (YAML or PGM), maps of `iog map`, and folders written by "
      "`iog record --out FOLDER`.");
  command->callback([path] {
    std::cout << summary_of_file(*path);
    demand_accepted_block(*path);
  });
}

}  // namespace iog::tools
