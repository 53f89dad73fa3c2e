// The table of a batch, RESULTS/summary.csv: one row per recording, in the order in which they
// ended. A batch that is started again goes on behind the last whole row.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "tools/program/table.hpp"

namespace iog::tools {

struct Outcome {
  std::string name;
  std::string reason{};   // why it failed; empty: it is done
  std::string remarks{};  // what the user has to know of a result
  Facts facts{};          // of `iog fuse --summary`
  double seconds = 0;
};

// Whether the folder has batch.txt, which a batch writes first, and a batch wrote it.
[[nodiscard]] bool has_settings_of_batch(const std::string& folder);

class Summary {
 public:
  // settings: lines on all that changes the results. Makes the folder. UsageError if the rows there
  // are of other settings or of another program, if another batch is writing them, or if the folder
  // cannot be written.
  Summary(const std::string& folder, const std::string& settings);
  ~Summary();
  Summary(const Summary&) = delete;
  Summary& operator=(const Summary&) = delete;

  [[nodiscard]] bool has(const std::string& name) const { return names_.contains(name); }
  [[nodiscard]] std::size_t failed() const { return failed_; }

  // Writes the whole row at once. The next batch removes a row that a killed process left
  // incomplete. UsageError if it cannot be written.
  void add(const Outcome& outcome);

 private:
  void read_rows();
  void append(const std::string& text);

  std::string path_;
  int file_ = -1;
  std::set<std::string> names_;
  std::size_t failed_ = 0;
};

}  // namespace iog::tools
