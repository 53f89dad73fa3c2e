// Numbers on the command line of a benchmark.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstring>
#include <system_error>

namespace iog::lab {

// 0 if the argument is no number, or one above the most.
inline std::size_t number_in(const char* argument, std::size_t most) {
  std::size_t number = 0;
  const char* const end = argument + std::strlen(argument);
  const auto [rest, fault] = std::from_chars(argument, end, number);
  return fault == std::errc{} && rest == end && number <= most ? number : 0;
}

}  // namespace iog::lab
