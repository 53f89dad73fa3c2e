// Prints the constants of the model: as words for scripts, one constant a line (name, nominal,
// optimistic, pessimistic), or with --markdown as the table of docs/a9_model.md.
#include <iostream>
#include <string_view>

#include "constants.hpp"

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kNever = 1'000'000'000;

void print_value(std::uint32_t value, bool markdown) {
  if (markdown && value == kNever) {
    std::cout << "never";
  } else {
    std::cout << value;
  }
}

std::string_view word_for(Certainty certainty) {
  switch (certainty) {
    case Certainty::kManual:
      return "by the manual";
    case Certainty::kPublished:
      return "published";
    case Certainty::kAssumed:
      break;
  }
  return "assumed";
}

void print(const Constant& constant, bool markdown) {
  const std::string_view gap = markdown ? " | " : " ";
  std::cout << (markdown ? "| `" : "") << constant.name << (markdown ? "`" : "") << gap;
  print_value(constant.nominal, markdown);
  std::cout << gap;
  print_value(constant.optimistic, markdown);
  std::cout << gap;
  print_value(constant.pessimistic, markdown);
  if (markdown) {
    std::cout << gap << word_for(constant.certainty) << gap << constant.source << " |";
  }
  std::cout << '\n';
}

}  // namespace

static void print_all(bool markdown) {
  if (markdown) {
    std::cout << "| constant | nominal | optimistic | pessimistic | certainty | source |\n"
                 "|---|--:|--:|--:|---|---|\n";
  }
  for (const Constant& constant : constants()) {
    print(constant, markdown);
  }
}

}  // namespace iog::a9_model

int main(int argc, char** argv) {
  const bool markdown = argc == 2 && std::string_view(argv[1]) == "--markdown";
  if (argc != 1 && !markdown) {
    std::cerr << "list_constants: expected no argument or --markdown\n";
    return 2;
  }
  iog::a9_model::print_all(markdown);
  return 0;
}
