// iog: everything a PC does for the grid. One subcommand for each file of tools/commands.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tools/commands/completion.hpp"
#include "tools/commands/output_options.hpp"
#include "tools/commands/subcommands.hpp"
#include "tools/program/program.hpp"

namespace iog::tools {
namespace {

// CLI11's ranges take "nan", which compares with nothing.
void demand_numbers(CLI::App& command) {
  for (CLI::Option* const option : command.get_options(
           [](const CLI::Option* its) { return its->get_type_name().starts_with("FLOAT"); })) {
    option->check([](const std::string& text) {
      return std::isfinite(std::strtod(text.c_str(), nullptr)) ? "" : text + " is not a number";
    });
  }
}

// CLI11 breaks no lines of a footer. Its own line breaks begin paragraphs.
std::string wrapped(const std::string& text) {
  constexpr std::size_t kWidth = 110;
  std::istringstream paragraphs(text);
  std::string made;
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    made += made.empty() ? "" : "\n";
    std::istringstream words(paragraph);
    std::size_t column = 0;
    for (std::string word; words >> word; column += word.size()) {
      const bool fits = column + 1 + word.size() <= kWidth;
      made += column == 0 ? "" : fits ? " " : "\n";
      column = column == 0 || !fits ? 0 : column + 1;
      made += word;
    }
  }
  return made;
}

// By what a user wants, in the order of --help.
void add_commands(CLI::App& program) {
  struct Group {
    const char* title;
    std::vector<void (*)(CLI::App&)> commands;
  };
  const std::vector<Group> groups{
      {"From a capture", {add_info, add_fuse, add_batch, add_view, add_record}},
      {"Make a capture", {add_simulate, add_points, add_convert, add_pose, add_odometry}},
      {"Live, with a target", {add_replay, add_relay, add_receive}},
      {"Cars", {add_vehicles, add_mount, add_budget}},
      {"Maps", {add_map, add_send_map}},
      {"Boards", {add_image}},
  };
  for (const Group& group : groups) {
    for (const auto add : group.commands) {
      add(program);
      CLI::App* const command = program.get_subcommands([](CLI::App*) { return true; }).back();
      command->group(group.title);
      command->footer(wrapped(command->get_footer()));
      demand_numbers(*command);
      command->parse_complete_callback([command] { check_outputs(*command); });
    }
  }
  add_help(program);
}

}  // namespace
}  // namespace iog::tools

int main(int argc, char** argv) {
  CLI::App program("Occupancy and perception grids from lidar packets", "iog");
  program.require_subcommand(1);
  program.set_version_flag("--version", IOG_VERSION);
  program.footer(
      "`iog help COMMAND` explains a command.\n"
      "Exit status: 0 done, 1 a check failed, 2 wrong use or unreadable input.");
  iog::tools::add_commands(program);
  if (argc > 1 && std::string_view(argv[1]) == iog::tools::kCompleteWord) {
    iog::tools::print_completions(program, {argv + 2, argv + argc});
    return 0;
  }
  return iog::tools::run_program(program, argc, argv);
}
