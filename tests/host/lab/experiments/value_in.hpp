// What a reader of an experiment's CSV finds there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lab/experiments/experiment.hpp"

namespace iog::lab {

// No quotes: for tables of names and numbers alone.
inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream rest(text);
  for (std::string part; std::getline(rest, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

// The value of a column in the first row that has these values in others. std::out_of_range if
// there is no such table, column or row.
inline std::string value_in(const Tables& tables, const std::string& name,
                            const std::string& column,
                            std::initializer_list<std::pair<std::string, std::string>> conditions) {
  const auto table =
      std::ranges::find_if(tables, [&](const Table& one) { return one.name() == name; });
  if (table == tables.end()) {
    throw std::out_of_range("no table " + name);
  }
  std::vector<std::string> lines = split(table->text(), '\n');
  const std::vector<std::string> columns = split(lines.at(0), ',');
  const auto place_of = [&](const std::string& wanted) {
    return static_cast<std::size_t>(std::ranges::find(columns, wanted) - columns.begin());
  };
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = split(lines[i], ',');
    if (std::ranges::all_of(conditions, [&](const auto& condition) {
          return cells.at(place_of(condition.first)) == condition.second;
        })) {
      return cells.at(place_of(column));
    }
  }
  throw std::out_of_range("no such row in " + name);
}

}  // namespace iog::lab
