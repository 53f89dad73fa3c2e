// iog help: what `--help` says.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "tools/commands/subcommands.hpp"
#include "tools/program/unknown_word.hpp"

namespace iog::tools {

void add_help(CLI::App& program) {
  auto* const command = program.add_subcommand("help", "Explain iog or one of its commands");
  const auto name = std::make_shared<std::string>();
  command->add_option("COMMAND", *name, "The command to explain")
      ->option_text(" ")
      ->check(CLI::IsMember(command_names(program)));
  command->group("");  // hidden
  command->callback([&program, name] {
    const CLI::App* const asked = name->empty() ? &program : program.get_subcommand(*name);
    const std::string words = program.get_name() + (name->empty() ? "" : " ") + *name;
    std::cout << program.get_formatter()->make_help(asked, words, CLI::AppFormatMode::Normal);
  });
}

}  // namespace iog::tools
