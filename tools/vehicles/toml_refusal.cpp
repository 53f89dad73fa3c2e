#include "tools/vehicles/toml_refusal.hpp"

#include <algorithm>

namespace iog::tools {
namespace {

using namespace std::string_view_literals;

// The most parts of a key, and the most open brackets. A car's file needs 3.
constexpr int kMostNesting = 8;
constexpr std::string_view kNestedTooDeep =
    "nested too deep: 8 parts of a key and 8 open brackets are the most";

// The length of the string at the beginning of the text (TOML 1.0.0, "String"). A string that does
// not end takes its line, or the rest of the text if it may span lines.
std::size_t length_of_string(std::string_view text) {
  const char quote = text.front();
  const std::string_view mark = text.substr(0, 3);
  const bool has_lines = mark == "\"\"\""sv || mark == "'''"sv;
  const std::size_t quotes = has_lines ? 3 : 1;
  for (std::size_t i = quotes; i < text.size(); ++i) {
    if (!has_lines && text[i] == '\n') {
      return i;
    }
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text.substr(i, quotes) == mark.substr(0, quotes)) {
      // Two more quotes may belong to a string of several lines.
      const std::size_t end = std::min(text.find_first_not_of(quote, i), text.size());
      return has_lines ? std::min(end, i + 5) : i + 1;
    }
  }
  return text.size();
}

}  // namespace

// A number has one point at most, so more of them in a row are a key's.
std::optional<TomlRefusal> refused_before_reading(std::string_view text) {
  std::uint32_t line = 1;
  int brackets = 0;
  int parts = 1;
  if (text.starts_with("\xEF\xBB\xBF"sv)) {  // the byte order mark
    text.remove_prefix(3);
  }
  while (!text.empty()) {
    const char next = text.front();
    std::size_t length = 1;
    if (next == '"' || next == '\'') {
      length = length_of_string(text);
    } else if (next == '#') {
      length = std::min(text.find('\n'), text.size());
    } else if ("\n=,[]{}"sv.find(next) != std::string_view::npos) {
      parts = 1;
      brackets += next == '[' || next == '{' ? 1 : 0;
      brackets -= (next == ']' || next == '}') && brackets > 0 ? 1 : 0;
    } else if (next == '.') {
      ++parts;
    }
    if (std::max(brackets, parts) > kMostNesting) {
      return TomlRefusal{line, kNestedTooDeep};
    }
    if (static_cast<unsigned char>(next) >= 0x80) {
      return TomlRefusal{line, "this is not TOML: outside of strings and comments, all is ASCII"};
    }
    line += static_cast<std::uint32_t>(std::ranges::count(text.substr(0, length), '\n'));
    text.remove_prefix(length);
  }
  return std::nullopt;
}

}  // namespace iog::tools
