// To which time sentences without a time belong: HDT and VTG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace iog::tools {

// Degrees clockwise from north, m/s.
struct TimedMotion {
  std::uint64_t time_us = 0;
  std::optional<double> speed_mps{};
  std::optional<double> course_deg{};
};

struct Untimed {
  std::size_t times_before = 0;  // so many times had begun in the log
  bool is_inside = false;        // a sentence of the last of these times follows
  std::optional<double> angle_deg{};
  std::optional<double> speed_mps{};
};

struct Cycle {
  std::vector<std::optional<std::size_t>> own;  // for each time, which untimed sentence is its own
  std::vector<double> open_s;                   // and how much earlier or later it may be
  bool is_order_open = false;
};

// A receiver writes what belongs to one time in one burst, always in the same order, so all that is
// open is whether the untimed sentence comes before or behind the others of its time. In this
// order:
//   - it stands between two sentences of one time;
//   - it comes more rarely than the times: then at whole multiples of its period;
//   - driven curves: its angles follow the courses better (angles are headings);
//   - the log opens with it and closes without it, or the other way round, as whole bursts do.
// If none of these decides, the beginning of the log is followed, and open_s says so. Sentences are
// counted between times: where one is lost, none is taken, or, if there are several, with open_s.
[[nodiscard]] Cycle cycle_of(const std::vector<TimedMotion>& times,
                             const std::vector<Untimed>& sentences, bool angles_are_headings,
                             bool is_cut_at_begin, bool is_cut_at_end);

}  // namespace iog::tools
