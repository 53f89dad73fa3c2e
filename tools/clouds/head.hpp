// How the head of a unit turns, clockwise, by the times at which it looked forward.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace iog::tools {

// When the head looks forward in the middle of a turn, which begins and ends to the rear.
struct ForwardTime {
  std::size_t turn = 0;  // numbered one after the other; some may be missing
  std::uint64_t time_us = 0;
};

class Head {
 public:
  // By rising turns, at least two. UsageError, which begins with `path`, if a turn between two of
  // them does not take 45 to 220 ms: a unit turns 5 to 20 times a second, and clocks do not go
  // back.
  Head(std::vector<ForwardTime> forward, const std::string& path);

  // Microseconds since the first of these times at which the head has turned so far: 3.25 looks to
  // the right in turn 3. Between two times it turns evenly, and before and behind them as there.
  [[nodiscard]] double time_at(double turns) const;
  [[nodiscard]] double turns_at(double time_us) const;

  [[nodiscard]] const ForwardTime& first() const { return forward_.front(); }

 private:
  struct Stretch {
    double turns = 0;
    double time_us = 0;
    double turn_us = 0;  // how long a turn takes from then on
  };
  template <typename Value>
  [[nodiscard]] const Stretch& stretch_of(double value, Value Stretch::*member) const;

  std::vector<ForwardTime> forward_;
  std::vector<Stretch> stretches_;
};

}  // namespace iog::tools
