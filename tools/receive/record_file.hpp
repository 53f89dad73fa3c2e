// Files with a line for each frame with evidence, numbered from 0, behind a heading.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {

[[nodiscard]] inline std::string words_of_other_file(const std::string& path, std::size_t frame,
                                                     const char* option) {
  return path + ": line for frame " + std::to_string(frame) + " expected; give a file that " +
         option + " has written";
}

// parsed(line): the record, or nothing. UsageError if it is another kind of file than `option`
// writes.
template <typename Record, typename Parse>
[[nodiscard]] std::vector<Record> read_record_file(const std::string& path, Parse&& parsed,
                                                   const char* option) {
  std::vector<Record> records;
  for (const std::string& line : read_lines(path)) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    const std::optional<Record> record = parsed(line);
    if (!record || record->number != records.size()) {
      throw UsageError(words_of_other_file(path, records.size(), option));
    }
    records.push_back(*record);
  }
  return records;
}

// line_of() of each.
template <typename Record>
void write_record_file(const std::string& path, const std::string& heading,
                       const std::vector<Record>& records) {
  OutputFile file(path);
  file.write(heading + "\n");
  for (const Record& record : records) {
    file.write(line_of(record) + "\n");
  }
  file.finish();
}

}  // namespace iog::tools
