// Observations on their way to lab/data: tables in CSV (RFC 4180), one observation a row.
//
// Columns are named in snake_case with their unit at the end (`range_m`, `share`, `time_ns`); what
// tells one observation from another stands before what was observed. Numbers are written with as
// few digits as give the same double again, so that the same numbers are the same bytes.
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace iog::lab {

class Table {
 public:
  // name: of the file, without ".csv". Values that were timed or are peculiar to a machine stand in
  // a table *_on_this_pc, what comes from recordings in a table *_recordings; lab/check compares
  // all others with lab/data byte for byte.
  Table(std::string name, const std::vector<std::string>& columns);

  // One observation: a string or a number for each column. std::invalid_argument if there are more
  // or fewer.
  template <typename... Values>
  void row(const Values&... values) {
    begin_row(sizeof...(values));
    (append(values), ...);
    text_.back() = '\n';
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void begin_row(std::size_t values) const;
  void append(std::string_view value);
  void append(double value);
  void append(std::integral auto value) { append_number(std::to_string(value)); }
  void append_number(std::string_view digits);

  std::string name_;
  std::size_t columns_;
  std::string text_;
};

// The power of ten that a difference stays below, 1e-15 at least: the digits of what rounding
// leaves differ from one C library to another.
[[nodiscard]] double difference_bound(double difference);

}  // namespace iog::lab
