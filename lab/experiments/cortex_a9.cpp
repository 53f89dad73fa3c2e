#include "lab/experiments/cortex_a9.hpp"

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include "lab/experiments/cortex_a9_lines.hpp"

namespace iog::lab {
namespace {

// Takes from the front of `text` what comes before the separator, and the separator.
std::string_view take_until(char separator, std::string_view& text) {
  const std::size_t end = text.find(separator);
  const std::string_view front = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return front;
}

// What follows in the first line that begins with these words and a separator.
std::optional<std::string_view> line_of(std::string_view words, char separator) {
  for (const std::string_view line : kCortexA9Lines) {
    if (line.starts_with(words) && line.substr(words.size()).starts_with(separator)) {
      return line.substr(words.size() + 1);
    }
  }
  return std::nullopt;
}

[[noreturn]] void missing(std::string_view what, std::string_view where) {
  std::string words("lab/target/cortex_a9.txt: no ");
  words.append(what).append(" in ").append(where);
  throw std::out_of_range(words);
}

}  // namespace

bool has_a9_run(std::string_view run) { return line_of(run, ' ').has_value(); }

std::string_view word_from_a9(std::string_view run, std::string_view key) {
  std::string_view pairs = line_of(run, ' ').value_or("");
  while (!pairs.empty()) {
    std::string_view value = take_until(' ', pairs);
    if (take_until('=', value) == key) {
      return value;
    }
  }
  missing(key, run);
}

double measured_on_a9(std::string_view run, std::string_view key) {
  const std::string_view word = word_from_a9(run, key);
  double value = 0;
  const char* const end = word.data() + word.size();
  const auto [rest, fault] = std::from_chars(word.data(), end, value);
  if (fault != std::errc{} || rest != end) {
    missing(key, run);
  }
  return value;
}

std::string_view a9_made_with(std::string_view name) {
  std::string beginning("# ");
  beginning.append(name);
  const std::optional<std::string_view> value = line_of(beginning, ':');
  if (!value) {
    missing(name, "the head");
  }
  return value->substr(1);
}

}  // namespace iog::lab
