#include "tools/commands/next_steps.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <unistd.h>

#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

std::string quoted(const std::string& word) {
  constexpr const char* kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./:,";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
    return word;
  }
  std::string text = "'";
  for (const char letter : word) {
    text += letter == '\'' ? "'\\''" : std::string(1, letter);
  }
  return text + "'";
}

// As the user gave them.
std::string words_of(const CLI::App& command, std::initializer_list<const char*> names) {
  std::string words;
  for (const char* const name : names) {
    const CLI::Option* const option = command.get_option(name);
    words += option->empty() ? "" : ' ' + std::string(name);
    for (const std::string& value : option->results()) {
      words += ' ' + quoted(value);
    }
  }
  return words;
}

}  // namespace

std::string rows_of_next_steps(const CLI::App& command) {
  if (isatty(STDOUT_FILENO) == 0 || isatty(STDERR_FILENO) == 0) {
    return "";
  }
  const std::string drive =
      words_of(command, {"--pcap", "--poses", "--poses-mount", "--poses-sigma", "--clock-offset",
                         "--vehicle", "--vehicle-file"});
  const std::filesystem::path capture = command.get_option("--pcap")->results().front();
  const std::string name = capture.stem().string();
  const std::string iog = quoted(program_invocation_name);
  const std::string record = iog + " record" + drive + words_of(command, {"--map"}) + " --out ";
  return "\nNext, for this drive:\n" + row("in the browser", iog + " view" + drive) +
         row("a picture per frame", record + quoted(name + "_pictures")) +
         row("for Foxglove, ROS 2", record + quoted(name + "_grids.mcap"));
}

}  // namespace iog::tools
