#include "tools/commands/serial_options.hpp"

#include "tools/program/add_option.hpp"
#include "tools/program/number_checks.hpp"

namespace iog::tools {

void add_serial_options(CLI::App& command, SerialOptions& options) {
  add_option(command, "--serial", "FILE", options.path,
             "Read a terminal device, a Unix socket such as QEMU's, or a file, instead of UDP")
      ->excludes("--port");
  add_option(command, "--baud", "RATE  (with --serial; default 115200)", options.baud,
             "Rate of the terminal device")
      ->needs("--serial");
  add_option(command, "--max-age", "SECONDS  (with --serial; default 5)", options.max_age_s,
             "Show cells older than this from the coarse grids")
      ->check(above_zero())
      ->needs("--serial");
  add_option(command, "--tiles", "FILE  (with --serial)", options.tiles,
             "Write frame, number and CRC of the cells of each received tile")
      ->needs("--serial");
}

}  // namespace iog::tools
