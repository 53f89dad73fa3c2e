#include "tools/view/json_text.hpp"

#include <array>
#include <charconv>

namespace iog::tools::view {

std::string quoted(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result;
  result.push_back('"');
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      result += '\\';
      result += letter;
    } else if (byte >= 0x20 && byte != 0x7F) {
      result += letter;
    } else {
      result += "\\u00";
      result += kDigits[byte >> 4U];
      result += kDigits[byte & 15U];
    }
  }
  result.push_back('"');
  return result;
}

JsonObject& JsonObject::json(std::string_view name, std::string_view value) {
  members_.append(members_.empty() ? "" : ",").append(quoted(name)).append(":").append(value);
  return *this;
}

JsonObject& JsonObject::text(std::string_view name, std::string_view value) {
  return json(name, quoted(value));
}

JsonObject& JsonObject::truth(std::string_view name, bool value) {
  return json(name, value ? "true" : "false");
}

JsonObject& JsonObject::real(std::string_view name, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return json(name, std::string_view(digits.data(), end.ptr));
}

JsonList& JsonList::json(std::string_view value) {
  values_.append(values_.empty() ? "" : ",").append(value);
  return *this;
}

}  // namespace iog::tools::view
