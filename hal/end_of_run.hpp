// Hardware interface that ends a run and reports how the previous run ended.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string_view>

namespace iog::hal {

// How a run has ended. The values are wire values (docs/spec.md 3.7).
enum class EndCause : std::uint32_t {
  kPowerUp = 0,       // unknown: there was no run, or its record is gone
  kWithoutAWord = 1,  // reset while it seemed alive: by its watchdog or the button
  kException = 2,     // processor exception; detail: its kind (docs/spec.md)
  kRequirement = 3,   // the program detected its own error; detail: source line
  kMemory = 4,        // constant memory has changed; detail: its number in the check's list
  kLate = 5,          // supervised parts did not report; detail: one bit for each
  kHang = 6,          // the loop hung until just before the watchdog reset; detail: where
};

struct End {
  EndCause cause = EndCause::kPowerUp;
  std::uint32_t detail = 0;
  friend constexpr bool operator==(const End&, const End&) = default;
};

struct RunBefore {
  std::uint32_t starts = 1;  // since power-up, this one included
  End end{};

  // Names in the stream (stream/target_table.hpp).
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"starts since power-up", "end of the run before", "detail of that end"});
  friend constexpr bool operator==(const RunBefore&, const RunBefore&) = default;
};

// end_run(end, words):  does not return on a machine. Stores `end` for the next run, and shows the
//                       words, at most 200 characters, to people.
// run_before():         how the previous run ended; constant within a run.
template <typename T>
concept EndsRuns = requires(T& machine, const T& view, End end, std::string_view words) {
  { machine.end_run(end, words) } -> std::same_as<void>;
  { view.run_before() } -> std::same_as<RunBefore>;
};

}  // namespace iog::hal
