// Hardware interface that ends a run and reports how the previous run ended.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string_view>

namespace iog::hal {

// The cause of the end of a run. The values are used on the wire (docs/spec.md 3.7).
enum class EndCause : std::uint32_t {
  kPowerUp = 0,       // unknown: there was no previous run, or its record is lost
  kWithoutAWord = 1,  // reset while the run seemed alive: by the watchdog or the reset button
  kException = 2,     // processor exception; detail: its kind (docs/spec.md)
  kRequirement = 3,   // the program detected its own error; detail: source line
  kMemory = 4,        // constant memory has changed; detail: the region's index in the memory check
  kLate = 5,          // supervised parts did not report; detail: one bit for each part
  kHang = 6,          // the loop hung until just before the watchdog reset; detail: location
};

struct End {
  EndCause cause = EndCause::kPowerUp;
  std::uint32_t detail = 0;
  friend constexpr bool operator==(const End&, const End&) = default;
};

struct RunBefore {
  std::uint32_t starts = 1;  // number of starts since power-up, including this one
  End end{};

  // The names of the counters in the stream (stream/target_table.hpp).
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"starts since power-up", "end of the run before", "detail of that end"});
  friend constexpr bool operator==(const RunBefore&, const RunBefore&) = default;
};

// `end_run(end, words)` ends the run, and does not return on a machine. `end_run()` stores `end`
// for the next run, and displays `words`, at most 200 characters, to the user. `run_before()`
// returns the end of the previous run, which is constant during a run.
template <typename T>
concept EndsRuns = requires(T& machine, const T& view, End end, std::string_view words) {
  { machine.end_run(end, words) } -> std::same_as<void>;
  { view.run_before() } -> std::same_as<RunBefore>;
};

}  // namespace iog::hal
