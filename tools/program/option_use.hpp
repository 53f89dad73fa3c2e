// Options that have an effect only beside others. CLI11's needs() says it of a single one.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

#include "tools/program/exit_status.hpp"

namespace iog::tools {

// UsageError if one of these options is given, and nothing uses it. what: what would use it.
inline void demand_use(const CLI::App& command, bool is_used,
                       std::initializer_list<const char*> options, const std::string& what) {
  for (const char* const name : options) {
    if (!is_used && command.get_option(name)->count() > 0) {
      throw UsageError(std::string(name) + " has no effect without " + what);
    }
  }
}

}  // namespace iog::tools
