// JSON as the page reads it, written piece by piece: only what the viewer needs.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace iog::tools::view {

// `text`, UTF-8, in quotes. What is not printable is escaped; so the result is valid wherever the
// text is UTF-8, and where it is not the page has a character of replacement for it.
[[nodiscard]] std::string quoted(std::string_view text);

// Members one after the other; str() closes it.
class JsonObject {
 public:
  JsonObject& text(std::string_view name, std::string_view value);
  JsonObject& truth(std::string_view name, bool value);
  JsonObject& real(std::string_view name, double value);  // finite
  // JSON that has been written already: an object, a list, or null.
  JsonObject& json(std::string_view name, std::string_view value);

  template <std::integral Value>
  JsonObject& number(std::string_view name, Value value) {
    return json(name, std::to_string(value));
  }

  [[nodiscard]] std::string str() const { return std::string("{").append(members_).append("}"); }

 private:
  std::string members_;
};

// Values one after the other; str() closes it.
class JsonList {
 public:
  JsonList& json(std::string_view value);
  JsonList& text(std::string_view value) { return json(quoted(value)); }

  [[nodiscard]] std::string str() const { return std::string("[").append(values_).append("]"); }

 private:
  std::string values_;
};

}  // namespace iog::tools::view
