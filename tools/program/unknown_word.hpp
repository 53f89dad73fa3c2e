// A word of the command line that the program does not know, and the one that may be meant.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tools/program/word_distance.hpp"

namespace iog::tools {

// Every option of a command that its help shows, those of its option groups among them.
[[nodiscard]] inline std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  std::vector<const CLI::Option*> options =
      command.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
  for (const CLI::App* const group :
       command.get_subcommands([](const CLI::App* each) { return each->get_name().empty(); })) {
    const std::vector<const CLI::Option*> more = options_of(*group);
    options.insert(options.end(), more.begin(), more.end());
  }
  return options;
}

// "--port"
[[nodiscard]] inline std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : options_of(command)) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  return names;
}

[[nodiscard]] inline std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* const command :
       program.get_subcommands([](const CLI::App* each) { return !each->get_name().empty(); })) {
    names.push_back(command->get_name());
  }
  return names;
}

// One line about the first word that neither the program nor the command that it runs has taken;
// none if they have taken every word. After parsing, which has failed.
[[nodiscard]] inline std::optional<std::string> words_of_unknown(const CLI::App& program) {
  const CLI::App* owner = &program;
  std::vector<std::string> left = program.remaining();
  if (const auto commands = program.get_subcommands(); left.empty() && !commands.empty()) {
    owner = commands.front();
    left = owner->remaining();
  }
  if (left.empty()) {
    return std::nullopt;
  }
  const std::string word = left.front().substr(0, left.front().find('='));
  const bool is_option = word.starts_with("-");
  const std::vector<std::string> known = is_option ? option_names(*owner) : command_names(*owner);
  const bool is_command = !is_option && owner == &program && !known.empty();
  const std::string text = is_command ? "no command '" + word + "'"
                                      : owner->get_name() + " takes no " +
                                            (is_option ? "option" : "argument") + " '" + word + "'";
  std::string meant;
  for (const std::string& each : nearest_words(word, known)) {
    meant += (meant.empty() ? "'" : " or '") + each + "'";
  }
  if (!meant.empty()) {
    return text + "; did you mean " + meant + "?";
  }
  if (!is_option && std::ranges::count(option_names(*owner), "--pcap") > 0) {
    return text + "; a capture needs --pcap in front of it";
  }
  const std::string name = owner == &program ? "" : " " + owner->get_name();
  return text + "; `" + program.get_name() + name + " --help` lists what there is";
}

}  // namespace iog::tools
