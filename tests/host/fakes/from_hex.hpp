// Bytes as papers and captures print them.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace iog::tests {

// Bytes from hexadecimal digits; blanks are for the eye.
inline std::vector<std::byte> from_hex(std::string_view text) {
  std::vector<std::byte> bytes;
  unsigned high = 0;
  bool half = false;
  for (const char c : text) {
    if (c == ' ') {
      continue;
    }
    const auto digit = static_cast<unsigned>(c <= '9' ? c - '0' : c - 'a' + 10);
    if (half) {
      bytes.push_back(static_cast<std::byte>(high << 4 | digit));
    }
    high = digit;
    half = !half;
  }
  return bytes;
}

}  // namespace iog::tests
