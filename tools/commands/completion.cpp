#include "tools/commands/completion.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <regex>

#include "tools/program/unknown_word.hpp"

namespace iog::tools {
namespace {

void print(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    std::cout << line << '\n';
  }
}

std::vector<std::string> found_in(const std::string& text, const char* pattern) {
  const std::regex each(pattern);
  return {std::sregex_token_iterator(text.begin(), text.end(), each, 1), {}};
}

void print_values(const CLI::Option& option) {
  // A validator of a list or a table writes {a,b} or {a->1,b->2}.
  if (const auto lists = found_in(option.get_type_name(), "\\{([^}]*)\\}"); !lists.empty()) {
    print(found_in(lists[0], "(?:^|,) *([^,>]*[^,>-])"));
    return;
  }
  const std::string words = option.get_name(true) + ' ' + option.get_option_text();
  const auto endings = found_in(words + ' ' + option.get_description(), "[ (A-Z](\\.[a-z][a-z.]*)");
  for (const std::string& ending : endings) {
    std::cout << '*' << ending << '\n';
  }
  if (endings.empty() && words.find("FILE") != std::string::npos) {
    std::cout << "*\n";
  }
  if (words.find("FOLDER") != std::string::npos) {
    std::cout << "*/\n";
  }
}

void print_for_command(const CLI::App& command, const std::vector<std::string>& words) {
  const std::vector<const CLI::Option*> options = options_of(command);
  const CLI::Option* open = nullptr;  // whose value the last word may be
  int taken = 0;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (words[i].starts_with("-")) {
      const auto named = std::ranges::find_if(
          options, [&](const CLI::Option* each) { return each->check_name(words[i]); });
      open = named == options.end() ? nullptr : *named;
      taken = 0;
    } else if (open != nullptr && ++taken >= open->get_items_expected_max()) {
      open = nullptr;
    }
  }
  if (!words.back().starts_with("-")) {
    if (open != nullptr && open->get_items_expected_max() > 0) {
      print_values(*open);
      if (taken < open->get_items_expected_min()) {
        return;
      }
    }
    for (const CLI::Option* const option : options) {
      if (option->get_positional()) {
        print_values(*option);
      }
    }
  }
  print(option_names(command));
}

}  // namespace

void print_completions(const CLI::App& program, std::vector<std::string> words) {
  // bash cuts `--rule=bayes` into three words.
  const bool is_value_empty = !words.empty() && words.back() == "=";
  std::erase(words, "=");
  if (words.empty() || is_value_empty) {
    words.emplace_back();
  }
  if (words.size() == 1) {
    print(command_names(program));
    print(option_names(program));
    return;
  }
  const auto commands = program.get_subcommands(
      [&](const CLI::App* each) { return each->check_name(words.front()); });
  if (!commands.empty()) {
    print_for_command(*commands.front(), {words.begin() + 1, words.end()});
  }
}

}  // namespace iog::tools
