// Options of `iog receive` for a target's serial line.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/receive/serial/reception.hpp"

namespace iog::tools {

// --serial, and those that need it.
void add_serial_options(CLI::App& command, SerialOptions& options);

}  // namespace iog::tools
