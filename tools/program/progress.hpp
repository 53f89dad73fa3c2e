// Progress of long work: one line on stderr that is written over, only when a person watches.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace iog::tools {

class Progress {
 public:
  // what: such as "frames". total 0: not known beforehand.
  explicit Progress(std::string what, std::uint64_t total = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Cheap: writes at most a few times a second.
  void show(std::uint64_t done);

 private:
  std::string what_;
  std::uint64_t total_;
  bool is_watched_;
  bool has_written_ = false;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace iog::tools
