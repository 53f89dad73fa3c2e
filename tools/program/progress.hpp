// Progress of long work: one line on stderr that is written over, only when a person watches.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace iog::tools {

class Progress {
 public:
  // what: such as "frames". total 0: not known beforehand.
  explicit Progress(std::string what, std::uint64_t total = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Cheap: writes at most a few times a second, and nothing of work that is done at once. part: of
  // all the work, 0 to 1, where something else than the total says it.
  void show(std::uint64_t done, std::optional<double> part = std::nullopt);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  std::uint64_t total_;
  bool is_watched_;
  bool has_written_ = false;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point next_;
};

// "packets 1200 [########............] 40 %, 0:12 left". The time is there from the third second
// on, as if what is left took as long as what has been done. part above 1 is 1.
[[nodiscard]] std::string progress_line(const std::string& what, std::uint64_t done,
                                        std::uint64_t total, std::optional<double> part,
                                        std::chrono::duration<double> since_begin);

}  // namespace iog::tools
