// The subcommands of `iog`. Each adds itself to the program and runs when it has been asked for.
#pragma once

namespace CLI {
class App;
}

namespace iog::tools {

void add_simulate(CLI::App& program);
void add_fuse(CLI::App& program);
void add_batch(CLI::App& program);
void add_points(CLI::App& program);
void add_pose(CLI::App& program);
void add_relay(CLI::App& program);
void add_replay(CLI::App& program);
void add_send_map(CLI::App& program);
void add_receive(CLI::App& program);
void add_record(CLI::App& program);
void add_convert(CLI::App& program);
void add_info(CLI::App& program);
void add_map(CLI::App& program);
void add_mount(CLI::App& program);
void add_odometry(CLI::App& program);
void add_vehicles(CLI::App& program);
void add_budget(CLI::App& program);
void add_image(CLI::App& program);
void add_view(CLI::App& program);
// The last, because it explains those that have been added.
void add_help(CLI::App& program);

}  // namespace iog::tools
