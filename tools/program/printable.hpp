// Text of a file or a network on its way to a terminal.
#pragma once

#include <cstddef>
#include <set>
#include <string>

namespace iog::tools {

// With "?" in place of everything that could command a terminal; letters of UTF-8 stay. Of a long
// text the first 500 bytes.
[[nodiscard]] std::string printable(std::string text);

// Lists names of a file in one text, six at most: "/a, /b, ...".
class FewNames {
 public:
  void add(std::string name);
  [[nodiscard]] bool is_empty() const { return names_.empty(); }
  [[nodiscard]] std::string words() const;

 private:
  static constexpr std::size_t kMost = 6;
  std::set<std::string> names_{};  // one more than that at most
};

}  // namespace iog::tools
