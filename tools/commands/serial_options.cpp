#include "tools/commands/serial_options.hpp"

namespace iog::tools {

void add_serial_options(CLI::App& command, SerialOptions& options) {
  command
      .add_option("--serial", options.path,
                  "Instead of UDP: a terminal device, a Unix socket such as QEMU's, or a file")
      ->option_text("PATH")
      ->excludes("--port");
  command.add_option("--baud", options.baud, "With --serial: the rate of a terminal device")
      ->option_text("RATE  (default 115200)")
      ->needs("--serial");
  command
      .add_option("--max-age", options.max_age_s,
                  "With --serial: show cells that are older as the coarse grids have them")
      ->option_text("SECONDS  (default 5)")
      ->check(CLI::PositiveNumber)
      ->needs("--serial");
  command
      .add_option("--tiles", options.tiles,
                  "With --serial: write frame, number and cells' CRC of each tile that was told of")
      ->option_text("FILE")
      ->needs("--serial");
}

}  // namespace iog::tools
