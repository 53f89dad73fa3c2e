// Prints the constants of the model: as words for scripts, one constant a line (name, nominal,
// optimistic, pessimistic), or with --csv as lab/data/a9_constants.csv, with where each is from.
#include <iostream>
#include <string>
#include <string_view>

#include "constants.hpp"

namespace iog::a9_model {
namespace {

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

// A field of RFC 4180.
std::string quoted(std::string_view text) {
  std::string field = "\"";
  for (const char letter : text) {
    field.append(letter == '"' ? 2 : 1, letter);
  }
  return field + '"';
}

void print_words() {
  for (const Constant& constant : constants()) {
    std::cout << constant.name << ' ' << constant.nominal << ' ' << constant.optimistic << ' '
              << constant.pessimistic << '\n';
  }
}

void print_csv() {
  std::cout << "constant,nominal,optimistic,pessimistic,certainty,source\n";
  for (const Constant& constant : constants()) {
    std::cout << constant.name << ',' << constant.nominal << ',' << constant.optimistic << ','
              << constant.pessimistic << ',' << word_for(constant.certainty) << ','
              << quoted(constant.source) << '\n';
  }
}

}  // namespace
}  // namespace iog::a9_model

int main(int argc, char** argv) {
  const bool csv = argc == 2 && std::string_view(argv[1]) == "--csv";
  if (argc != 1 && !csv) {
    std::cerr << "a9_constants: expected no argument or --csv\n";
    return 2;
  }
  if (csv) {
    iog::a9_model::print_csv();
  } else {
    iog::a9_model::print_words();
  }
  return 0;
}
