// A table of a TOML file, read key by key. What is wrong is noted with its line, its field and what
// is allowed there, and reading goes on.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <vector>

#include "net/address.hpp"

namespace iog::tools {

struct Mistake {
  std::uint32_t line = 0;   // from 1
  std::string field;        // "sensors[0].udp_port"
  std::string words;        // "allowed is ..."
  bool is_unknown = false;  // nobody knows the key: nothing depends on it
};

// A word of the file and what it stands for.
template <typename Value>
struct Choice {
  std::string_view word;
  Value value;
};

class TomlTable {
 public:
  // path: of the table in the file, empty for the file itself. Both outlive it.
  TomlTable(const toml::table& table, std::string path, std::vector<Mistake>& mistakes);

  // Each leaves the value alone if the key is missing or what it holds is not allowed.
  void read(std::string_view key, bool& value);
  void read(std::string_view key, double& value);
  void read(std::string_view key, std::string& value);
  void read(std::string_view key, net::MacAddress& value);   // "02:69:6f:67:00:01"
  void read(std::string_view key, net::Ipv4Address& value);  // "10.0.2.15"

  template <std::unsigned_integral Whole>
  void read(std::string_view key, Whole& value) {
    std::uint64_t wide = value;
    read_whole(key, std::numeric_limits<Whole>::max(), wide);
    value = static_cast<Whole>(wide);
  }

  template <typename Value, std::size_t kCount>
  void read(std::string_view key, Value& value, const std::array<Choice<Value>, kCount>& choices) {
    std::vector<std::string_view> words(kCount);
    std::ranges::transform(choices, words.begin(), &Choice<Value>::word);
    if (const std::optional<std::size_t> chosen = read_word(key, words)) {
      value = choices[*chosen].value;
    }
  }

  // Which of the words the key holds.
  [[nodiscard]] std::optional<std::size_t> read_word(std::string_view key,
                                                     const std::vector<std::string_view>& words);

  // The table of that key; an empty one of which nothing is demanded if there is none.
  [[nodiscard]] TomlTable table(std::string_view key, std::string_view allowed = "a table");
  // The tables of that key's array; none if there is no such array.
  [[nodiscard]] std::vector<TomlTable> tables(std::string_view key);

  // A key that is asked for is a known one.
  [[nodiscard]] bool has(std::string_view key) { return find(key) != nullptr; }

  // Whether somebody has asked for that key.
  [[nodiscard]] bool knows(std::string_view key) const;

  // Whether it is `false`, which says of a table that there is none.
  [[nodiscard]] bool is_false(std::string_view key);

  // Notes each of the keys that is missing; none if the whole table is.
  void demand(const std::vector<std::string_view>& keys);
  // Notes, if the key is there, that its value is not one of those allowed.
  void refuse(std::string_view key, std::string_view allowed);
  // Notes each key that nobody has asked for. Once, at the end.
  void refuse_others();

 private:
  [[nodiscard]] const toml::node* find(std::string_view key);
  void read_whole(std::string_view key, std::uint64_t most, std::uint64_t& value);
  [[nodiscard]] std::optional<std::string> text_of(std::string_view key, std::string_view allowed);
  [[nodiscard]] std::string field(std::string_view key) const;
  void note(const toml::node& node, std::string_view key, std::string_view allowed);

  const toml::table* table_;
  std::string path_;
  std::vector<Mistake>* mistakes_;
  std::vector<std::string_view> known_;
};

}  // namespace iog::tools
