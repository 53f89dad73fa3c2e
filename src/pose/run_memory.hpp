// Stores the current run and earlier accepted runs of the pose source.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::pose {

class RunMemory {
 public:
  [[nodiscard]] bool is_present(std::uint32_t run) const {
    return count_ > 0 && runs_[(next_ + kRuns - 1) % kRuns] == run;
  }

  // Returns true if `run` is one of the last fifteen runs before the current one. Older runs are
  // not remembered.
  [[nodiscard]] bool is_past(std::uint32_t run) const {
    const auto known = std::span(runs_).first(count_);
    return !is_present(run) && std::ranges::find(known, run) != known.end();
  }

  // Makes `run` the current run. Earlier runs are allowed, but `run` must not be the current run
  // already.
  void begin(std::uint32_t run) {
    runs_[next_] = run;
    next_ = (next_ + 1) % kRuns;
    count_ = std::min(count_ + 1, kRuns);
  }

 private:
  static constexpr std::size_t kRuns = 16;
  std::array<std::uint32_t, kRuns> runs_{};  // a ring buffer; the oldest run is overwritten
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace iog::pose
