// How a program of the PC ends: its command line read, its work done, its exit status said.
#pragma once

#include <CLI/CLI.hpp>
#include <cerrno>
#include <exception>
#include <iostream>

#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/unknown_word.hpp"

namespace iog::tools {

// Runs what the command line asks of the program. What went wrong is on stderr behind the program's
// name.
[[nodiscard]] inline int status_of(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      return program.exit(error);  // --help and --version
    }
    if (const auto unknown = words_of_unknown(program)) {
      std::cerr << program.get_name() << ": " << *unknown << '\n';
    } else {
      program.exit(error);
    }
    return kWrongUse;
  } catch (const CheckFailed& failure) {
    std::cerr << program.get_name() << ": " << failure.what() << '\n';
    return kCheckFailed;
  } catch (const std::exception& error) {
    std::cerr << program.get_name() << ": " << error.what() << '\n';
    return kWrongUse;
  }
  return kDone;
}

// Returns the status for main(). If standard output cannot be written, as on a full disk, the
// program fails.
[[nodiscard]] inline int run_program(CLI::App& program, int argc, char** argv) {
  const int status = status_of(program, argc, argv);
  errno = 0;
  if (std::cout.flush() || status != kDone) {
    return status;
  }
  std::cerr << program.get_name() << ": "
            << file_error("standard output", "cannot be written").what() << '\n';
  return kWrongUse;
}

}  // namespace iog::tools
