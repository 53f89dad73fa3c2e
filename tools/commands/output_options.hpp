// The files that a command writes, against those that it reads.
#pragma once

#include <CLI/CLI.hpp>

namespace iog::tools {

// UsageError if an output of this parsed command is also one of its inputs, is given twice, or
// cannot be created at its path. Links are followed. To be called before anything is opened for
// writing.
void check_outputs(const CLI::App& command);

}  // namespace iog::tools
