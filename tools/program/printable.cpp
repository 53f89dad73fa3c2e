#include "tools/program/printable.hpp"

#include <utility>

namespace iog::tools {

std::string printable(std::string text) {
  constexpr std::size_t kMostBytes = 500;
  unsigned char before = 0;
  for (char& letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    // 0x80 ... 0x9F go on in a letter of UTF-8, but are commands by themselves and behind 0xC2.
    const bool is_second = before >= 0x80 && before != 0xC2;
    if (code < ' ' || code == 0x7F || (code >= 0x80 && code < 0xA0 && !is_second)) {
      letter = '?';
    }
    before = code;
  }
  if (text.size() > kMostBytes) {
    text.replace(kMostBytes, std::string::npos, "...");
  }
  return text;
}

void FewNames::add(std::string name) {
  if (names_.size() <= kMost) {
    names_.insert(printable(std::move(name)));
  }
}

std::string FewNames::words() const {
  std::string text;
  std::size_t left = kMost;
  for (const std::string& name : names_) {
    text += (text.empty() ? "" : ", ") + (left == 0 ? "..." : name);
    left -= left == 0 ? 0 : 1;
  }
  return text;
}

}  // namespace iog::tools
