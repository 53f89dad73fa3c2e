// iog: everything a PC does for the grid. One subcommand for each room of tools/.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "tools/command/exit_status.hpp"
#include "tools/command/subcommands.hpp"

int main(int argc, char** argv) {
  namespace tools = iog::tools;
  CLI::App program("Occupancy grids from lidar scans: simulate, fuse, replay, receive, show",
                   "iog");
  program.require_subcommand(1);
  program.footer("Exit status: 0 done, 1 a check failed, 2 wrong use or unreadable input.");
  tools::add_simulate(program);
  tools::add_worst(program);
  tools::add_fuse(program);
  tools::add_replay(program);
  tools::add_receive(program);
  tools::add_record(program);
  tools::add_convert(program);
  tools::add_info(program);
  tools::add_tables(program);
  tools::add_vehicles(program);
  tools::add_view(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? tools::kDone : tools::kWrongUse;
  } catch (const tools::CheckFailed& failure) {
    std::cerr << "iog: " << failure.what() << '\n';
    return tools::kCheckFailed;
  } catch (const std::exception& error) {
    std::cerr << "iog: " << error.what() << '\n';
    return tools::kWrongUse;
  }
  return tools::kDone;
}
