// Finds the epoch of sentences that carry no time: HDT and VTG.
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
  std::size_t times_before = 0;  // times that had begun in the log before it
  bool is_inside = false;        // a sentence of the last of these times follows
  std::optional<double> angle_deg{};
  std::optional<double> speed_mps{};
};

struct Cycle {
  std::vector<std::optional<std::size_t>> own;  // for each time, which untimed sentence is its own
  std::vector<double> open_s;                   // and how much earlier or later it may be
  bool is_order_open = false;
};

// A receiver writes all sentences of one time in one burst, always in the same order, so the only
// question is whether the untimed sentence comes before or after the others. Signs, in this order:
//   - it stands between two sentences of one time;
//   - it is rarer than the times: then it belongs to whole multiples of its period;
//   - driven curves: its angles follow the courses better (angles are headings);
//   - the log opens with it and closes without it, or the other way round, as whole bursts do.
// If none of these decides, the order at the beginning of the log is taken, and open_s says so.
// Sentences are counted between times: where one is lost none is assigned, or, if there are
// several, one with open_s.
[[nodiscard]] Cycle cycle_of(const std::vector<TimedMotion>& times,
                             const std::vector<Untimed>& sentences, bool angles_are_headings,
                             bool is_cut_at_begin, bool is_cut_at_end);

}  // namespace iog::tools
