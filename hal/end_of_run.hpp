// The seam to how a run ends, and to what is known of the run before this one.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string_view>

namespace iog::hal {

// How a run has ended. The numbers are on the wire (docs/spec.md 3.7).
enum class EndCause : std::uint32_t {
  kPowerUp = 0,       // nothing is known: there was no run, or its record is gone
  kWithoutAWord = 1,  // reset while it seemed alive: its watchdog, or the button
  kException = 2,     // of the processor; detail: its kind (docs/spec.md)
  kRequirement = 3,   // the program found itself wrong; detail: line of its source
  kMemory = 4,        // what must not change has changed; detail: its number in the check's list
  kLate = 5,          // supervised parts did not report; detail: a bit for each of them
  kHang = 6,          // the loop hung until the watchdog was about to reset; detail: where
};

struct End {
  EndCause cause = EndCause::kPowerUp;
  std::uint32_t detail = 0;
  friend constexpr bool operator==(const End&, const End&) = default;
};

struct RunBefore {
  std::uint32_t starts = 1;  // since power-up, this one included
  End end{};

  // In the stream (stream/target_table.hpp).
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"starts since power-up", "end of the run before", "detail of that end"});
  friend constexpr bool operator==(const RunBefore&, const RunBefore&) = default;
};

// end_run(end, words):  does not return on a machine. The next run finds the end, and people the
//                       words, at most 200 characters.
// run_before():         the same from start to end of a run.
template <typename T>
concept EndsRuns = requires(T& machine, const T& view, End end, std::string_view words) {
  { machine.end_run(end, words) } -> std::same_as<void>;
  { view.run_before() } -> std::same_as<RunBefore>;
};

}  // namespace iog::hal
