// An option of a command: its name, what its value is, where that goes, and what it is for.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace iog::tools {

template <typename Value>
CLI::Option* add_option(CLI::App& command, const std::string& name, const std::string& text,
                        Value& value, const std::string& purpose) {
  return command.add_option(name, value, purpose)->option_text(text);
}

}  // namespace iog::tools
