#include "tools/batch/summary.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string_view>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include "tools/program/file.hpp"
#include "tools/program/fixed.hpp"

namespace iog::tools {
namespace {

constexpr std::string_view kDoneWord = "done";
constexpr std::string_view kFailedWord = "failed";

constexpr std::array kFacts{"frames",         "frames_with_evidence", "points_used",
                            "packets_placed", "packets_not_placed",   "run_hash",
                            "class_run_hash", "object_run_hash"};

std::vector<std::string> head() {
  std::vector<std::string> names{"name", "status"};
  names.insert(names.end(), kFacts.begin(), kFacts.end());
  names.insert(names.end(), {"points", "packets_dropped", "seconds", "reason", "remarks"});
  return names;
}

std::string value_of(const Facts& facts, std::string_view name) {
  const auto found = std::ranges::find(facts, name, &Facts::value_type::first);
  return found == facts.end() ? std::string() : found->second;
}

// Of all counts whose name begins so; empty if there is none.
std::string sum_of(const Facts& facts, std::string_view prefix,
                   std::initializer_list<std::string_view> without) {
  std::uint64_t sum = 0;
  for (const auto& [name, value] : facts) {
    sum += name.starts_with(prefix) && std::ranges::find(without, name) == without.end()
               ? std::stoull(value)
               : 0;
  }
  return facts.empty() ? std::string() : std::to_string(sum);
}

// The first two fields of each whole row, and where the last of these rows ends.
struct Rows {
  std::vector<std::array<std::string, 2>> rows;
  std::size_t end = 0;
};

Rows rows_of(std::string_view text) {
  Rows found;
  std::array<std::string, 2> row;
  std::size_t field = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_double = is_quoted && text.substr(i).starts_with("\"\"");
    i += is_double ? 1 : 0;
    if (text[i] == '"' && !is_double) {
      is_quoted = !is_quoted;
    } else if (text[i] == ',' && !is_quoted) {
      ++field;
    } else if (text[i] == '\n' && !is_quoted) {
      found.rows.push_back(std::exchange(row, {}));
      found.end = i + 1;
      field = 0;
    } else if (field < row.size()) {
      row[field] += text[i];
    }
  }
  return found;
}

// One row of CSV (RFC 4180) with its end.
std::string csv_row(const std::vector<std::string>& fields) {
  std::string row;
  for (const std::string& field : fields) {
    row += &field == &fields.front() ? "" : ",";
    if (field.find_first_of(",\"\r\n") == std::string::npos) {
      row += field;
      continue;
    }
    row += '"';
    for (const char letter : field) {
      row += letter == '"' ? "\"\"" : std::string(1, letter);
    }
    row += '"';
  }
  return row + '\n';
}

std::string csv_row(const Outcome& outcome) {
  std::vector<std::string> fields{outcome.name,
                                  std::string(outcome.reason.empty() ? kDoneWord : kFailedWord)};
  for (const char* const name : kFacts) {
    fields.push_back(value_of(outcome.facts, name));
  }
  fields.push_back(sum_of(outcome.facts, "points_", {}));
  fields.push_back(sum_of(outcome.facts, "packets_", {"packets_placed", "packets_not_placed"}));
  fields.insert(fields.end(), {fixed(outcome.seconds, 2), outcome.reason, outcome.remarks});
  return csv_row(fields);
}

}  // namespace

bool has_settings_of_batch(const std::string& folder) {
  const std::string path = folder + "/batch.txt";
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return false;
  }
  const std::vector<std::string> lines = read_lines(path);
  return lines.size() == 3 && lines[1].starts_with("car ") && lines[2].starts_with("options ");
}

Summary::Summary(const std::string& folder, const std::string& settings)
    : path_(folder + "/summary.csv") {
  make_folder(folder);
  errno = 0;
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw file_error(path_, "cannot be written");
  }
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    throw UsageError(path_ + ": another iog batch is writing this table");
  }
  const std::string of_rows = folder + "/batch.txt";
  if (std::filesystem::file_size(path_) == 0) {
    OutputFile file(of_rows);
    file.write(settings);
    file.finish();
    append(csv_row(head()));
  } else if (!std::filesystem::exists(of_rows)) {
    throw UsageError(path_ + ": iog batch did not write this table; give another --out");
  } else if (const auto known = read_file(of_rows);
             !std::ranges::equal(known, std::as_bytes(std::span(settings)))) {
    throw UsageError(path_ + ": its rows are of another car, other options or another iog, see " +
                     of_rows + "; give another --out");
  }
  read_rows();
}

Summary::~Summary() { close(file_); }

void Summary::read_rows() {
  const std::vector<std::byte> bytes = read_file(path_);
  const Rows known = rows_of({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (known.rows.empty() || known.rows[0][0] != "name" || known.rows[0][1] != "status") {
    throw UsageError(path_ + ": iog batch did not write this table; give another --out");
  }
  for (const auto& [name, status] : std::span(known.rows).subspan(1)) {
    names_.insert(name);
    failed_ += status == kFailedWord ? 1U : 0U;
  }
  errno = 0;
  if (ftruncate(file_, static_cast<off_t>(known.end)) != 0) {
    throw file_error(path_, "cannot be written");
  }
}

void Summary::append(const std::string& text) {
  errno = 0;
  if (write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    throw file_error(path_, "cannot be written any more");
  }
}

void Summary::add(const Outcome& outcome) {
  append(csv_row(outcome));
  names_.insert(outcome.name);
  failed_ += outcome.reason.empty() ? 0U : 1U;
}

}  // namespace iog::tools
