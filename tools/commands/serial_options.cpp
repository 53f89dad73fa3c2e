#include "tools/commands/serial_options.hpp"

namespace iog::tools {

void add_serial_options(CLI::App& command, SerialOptions& options) {
  command
      .add_option("--serial", options.path,
                  "Read a terminal device, a Unix socket such as QEMU's, or a file, instead of UDP")
      ->option_text("FILE")
      ->excludes("--port");
  command.add_option("--baud", options.baud, "Rate of the terminal device")
      ->option_text("RATE  (with --serial; default 115200)")
      ->needs("--serial");
  command
      .add_option("--max-age", options.max_age_s,
                  "Show cells older than this from the coarse grids")
      ->option_text("SECONDS  (with --serial; default 5)")
      ->check(CLI::PositiveNumber)
      ->needs("--serial");
  command
      .add_option("--tiles", options.tiles,
                  "Write frame, number and CRC of the cells of each received tile")
      ->option_text("FILE  (with --serial)")
      ->needs("--serial");
}

}  // namespace iog::tools
