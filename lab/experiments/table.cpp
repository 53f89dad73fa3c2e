#include "lab/experiments/table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace iog::lab {

Table::Table(std::string name, const std::vector<std::string>& columns)
    : name_(std::move(name)), columns_(columns.size()) {
  if (columns.empty()) {
    throw std::invalid_argument("table " + name_ + " has no columns");
  }
  for (const std::string& column : columns) {
    append(std::string_view(column));
  }
  text_.back() = '\n';
}

void Table::begin_row(std::size_t values) const {
  if (values != columns_) {
    throw std::invalid_argument("table " + name_ + " has " + std::to_string(columns_) +
                                " columns, a row has " + std::to_string(values));
  }
}

void Table::append(std::string_view value) {
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
    append_number(value);
    return;
  }
  text_ += '"';
  for (const char character : value) {
    text_.append(character == '"' ? 2 : 1, character);
  }
  text_ += "\",";
}

void Table::append(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  append_number({digits.data(), end});
}

void Table::append_number(std::string_view digits) { text_.append(digits).push_back(','); }

double difference_bound(double difference) {
  const double exponent = difference > 0 ? std::floor(std::log10(difference)) + 1 : -15;
  return std::pow(10.0, std::max(exponent, -15.0));
}

}  // namespace iog::lab
