#include "tools/vehicles/toml_table.hpp"

#include <charconv>
#include <utility>

#include "tools/program/joined.hpp"

namespace iog::tools {
namespace {

// The numbers between the separators, of exactly `kCount` parts; none if it is not that.
template <std::size_t kCount>
std::optional<std::array<std::uint8_t, kCount>> octets_of(std::string_view text, char separator,
                                                          int base) {
  std::array<std::uint8_t, kCount> octets{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), octets[i], base);
    if (error != std::errc()) {
      return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    const bool is_last = i + 1 == kCount;
    if (is_last != text.empty() || (!is_last && text.front() != separator)) {
      return std::nullopt;
    }
    text.remove_prefix(is_last ? 0 : 1);
  }
  return octets;
}

const toml::table kEmpty{};

}  // namespace

TomlTable::TomlTable(const toml::table& table, std::string path, std::vector<Mistake>& mistakes)
    : table_(&table), path_(std::move(path)), mistakes_(&mistakes) {}

const toml::node* TomlTable::find(std::string_view key) {
  if (std::ranges::find(known_, key) == known_.end()) {
    known_.push_back(key);
  }
  return table_->get(key);
}

std::string TomlTable::field(std::string_view key) const {
  return path_ + (path_.empty() ? "" : ".") + std::string(key);
}

void TomlTable::note(const toml::node& node, std::string_view key, std::string_view allowed) {
  mistakes_->push_back(
      {node.source().begin.line, field(key), "allowed is " + std::string(allowed)});
}

void TomlTable::read(std::string_view key, bool& value) {
  if (const toml::node* const node = find(key)) {
    if (node->is_boolean()) {
      value = node->as_boolean()->get();
    } else {
      note(*node, key, "true or false");
    }
  }
}

bool TomlTable::knows(std::string_view key) const {
  return std::ranges::find(known_, key) != known_.end();
}

bool TomlTable::is_false(std::string_view key) {
  const toml::node* const node = find(key);
  return node != nullptr && node->is_boolean() && !node->as_boolean()->get();
}

void TomlTable::read(std::string_view key, double& value) {
  if (const toml::node* const node = find(key)) {
    if (node->is_number()) {
      value = *node->value<double>();
    } else {
      note(*node, key, "a number");
    }
  }
}

void TomlTable::read_whole(std::string_view key, std::uint64_t most, std::uint64_t& value) {
  const toml::node* const node = find(key);
  if (node == nullptr) {
    return;
  }
  const std::int64_t number = node->is_integer() ? node->as_integer()->get() : -1;
  if (number >= 0 && static_cast<std::uint64_t>(number) <= most) {
    value = static_cast<std::uint64_t>(number);
  } else {
    note(*node, key, "a whole number, 0 ... " + std::to_string(most));
  }
}

std::optional<std::string> TomlTable::text_of(std::string_view key, std::string_view allowed) {
  const toml::node* const node = find(key);
  if (node == nullptr) {
    return std::nullopt;
  }
  if (!node->is_string()) {
    note(*node, key, allowed);
    return std::nullopt;
  }
  return node->as_string()->get();
}

void TomlTable::read(std::string_view key, std::string& value) {
  if (const std::optional<std::string> text = text_of(key, "a text in quotes")) {
    value = *text;
  }
}

void TomlTable::read(std::string_view key, net::MacAddress& value) {
  constexpr std::string_view kAllowed = "an Ethernet address, such as \"02:69:6f:67:00:01\"";
  if (const std::optional<std::string> text = text_of(key, kAllowed)) {
    if (const auto octets = octets_of<6>(*text, ':', 16)) {
      value.octets = *octets;
    } else {
      note(*table_->get(key), key, kAllowed);
    }
  }
}

void TomlTable::read(std::string_view key, net::Ipv4Address& value) {
  constexpr std::string_view kAllowed = "an IPv4 address, such as \"10.0.2.15\"";
  if (const std::optional<std::string> text = text_of(key, kAllowed)) {
    if (const auto octets = octets_of<4>(*text, '.', 10)) {
      value = net::ipv4((*octets)[0], (*octets)[1], (*octets)[2], (*octets)[3]);
    } else {
      note(*table_->get(key), key, kAllowed);
    }
  }
}

std::optional<std::size_t> TomlTable::read_word(std::string_view key,
                                                const std::vector<std::string_view>& words) {
  const std::string allowed = "one of the texts " + joined(words, ", ");
  const std::optional<std::string> text = text_of(key, allowed);
  if (!text) {
    return std::nullopt;
  }
  const auto found = std::ranges::find(words, std::string_view(*text));
  if (found == words.end()) {
    note(*table_->get(key), key, allowed);
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - words.begin());
}

TomlTable TomlTable::table(std::string_view key, std::string_view allowed) {
  const toml::node* const node = find(key);
  if (node == nullptr) {
    return {kEmpty, field(key), *mistakes_};
  }
  if (!node->is_table()) {
    note(*node, key, allowed);
    return {kEmpty, field(key), *mistakes_};
  }
  return {*node->as_table(), field(key), *mistakes_};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  std::vector<TomlTable> tables;
  const toml::node* const node = find(key);
  if (node == nullptr) {
    return tables;
  }
  if (!node->is_array_of_tables()) {
    note(*node, key, "an array of tables, at least one");
    return tables;
  }
  for (const toml::node& element : *node->as_array()) {
    tables.emplace_back(*element.as_table(), field(key) + '[' + std::to_string(tables.size()) + ']',
                        *mistakes_);
  }
  return tables;
}

void TomlTable::demand(const std::vector<std::string_view>& keys) {
  for (const std::string_view key : keys) {
    if (table_ != &kEmpty && !has(key)) {
      const std::uint32_t line = std::max(table_->source().begin.line, std::uint32_t{1});
      mistakes_->push_back({line, field(key), "is missing"});
    }
  }
}

void TomlTable::refuse(std::string_view key, std::string_view allowed) {
  if (const toml::node* const node = find(key)) {
    note(*node, key, allowed);
  }
}

void TomlTable::refuse_others() {
  for (const auto& [key, node] : *table_) {
    if (!knows(key.str())) {
      mistakes_->push_back({key.source().begin.line, field(key.str()),
                            "no such key; allowed are " + joined(known_, ", "), true});
    }
  }
}

}  // namespace iog::tools
