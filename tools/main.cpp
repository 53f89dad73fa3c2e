// iog: everything a PC does for the grid. One subcommand for each file of tools/commands.
#include <CLI/CLI.hpp>

#include "tools/commands/subcommands.hpp"
#include "tools/program/program.hpp"

int main(int argc, char** argv) {
  namespace tools = iog::tools;
  CLI::App program("Occupancy grids from lidar scans: simulate, fuse, replay, receive, show",
                   "iog");
  program.require_subcommand(1);
  program.set_version_flag("--version", IOG_VERSION);
  program.footer("Exit status: 0 done, 1 a check failed, 2 wrong use or unreadable input.");
  tools::add_simulate(program);
  tools::add_fuse(program);
  tools::add_points(program);
  tools::add_pose(program);
  tools::add_replay(program);
  tools::add_relay(program);
  tools::add_send_map(program);
  tools::add_receive(program);
  tools::add_record(program);
  tools::add_convert(program);
  tools::add_info(program);
  tools::add_map(program);
  tools::add_mount(program);
  tools::add_odometry(program);
  tools::add_vehicles(program);
  tools::add_budget(program);
  tools::add_image(program);
  tools::add_view(program);
  return tools::run_program(program, argc, argv);
}
