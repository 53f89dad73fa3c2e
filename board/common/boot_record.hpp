// What a run leaves to the next one: a record in DDR that no reset clears and no loader overwrites.
// It has the run's number, too, so that receivers tell one run from another (hal/run_number.hpp).
//
// After power-up DDR holds anything, so a record counts only if its seal fits its contents. The
// region is mapped uncached, and whatever writes to it ends by drain_stores() of the board's
// Memory. So what is written is in memory when the function returns.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/end_of_run.hpp"

namespace iog::board {

struct BootRecord {
  static constexpr std::size_t kLastWordBytes = 240;

  std::uint32_t seal;
  std::uint32_t boots;       // since the cold start
  std::uint32_t run_number;  // of the last run that had one, 0: none since the cold start
  std::uint32_t cause;       // hal::EndCause of a last word
  std::uint32_t detail;      // of its hal::End
  std::uint32_t last_word_bytes;
  std::array<char, kLastWordBytes> last_word;
};

// The record, at an address of linker/<board>.ld. It is deliberately never initialised.
extern "C" BootRecord boot_record;

// DDR behind the record that is never written: what the power-up left there.
// NOLINTNEXTLINE(readability-identifier-naming): a symbol of the linker script
extern "C" const std::array<std::uint32_t, 1024> boot_noise;

// What a boot learns about the run before it.
struct Boot {
  hal::RunBefore before{};
  std::uint32_t last_word_bytes = 0;
  std::array<char, BootRecord::kLastWordBytes> last_word{};

  std::string_view last_word_text() const { return {last_word.data(), last_word_bytes}; }
};

// What differs from one cold start to the next, if it is read when the board has started.
struct Differences {
  // DDR as the power-up left it: some cells fall to either side. All else may be the same.
  std::span<const std::uint32_t> noise{};
  std::uint32_t ticks = 0;  // of a fast clock, after waits for other clocks
  std::array<std::uint8_t, 6> mac{};
};

namespace detail {
Boot open(BootRecord& record);
std::uint32_t begin_run(BootRecord& record, const Differences& differences);
void write_last_word(BootRecord& record, hal::End end, std::string_view text);
}  // namespace detail

// Reads the record once, removes its last word and counts this boot.
template <typename Memory>
Boot open_boot_record(BootRecord& record, Memory& memory) {
  const Boot boot = detail::open(record);
  memory.drain_stores();
  return boot;
}

// The number of this run, never 0: one more than that of the run before. If the record has none, a
// number drawn from the differences, each bit of it from all of them.
template <typename Memory>
std::uint32_t begin_run(BootRecord& record, const Differences& differences, Memory& memory) {
  const std::uint32_t number = detail::begin_run(record, differences);
  memory.drain_stores();
  return number;
}

// Leaves a last word, which is not empty, for the next boot; it is cut to the space there is.
template <typename Memory>
void write_last_word(BootRecord& record, hal::End end, std::string_view text, Memory& memory) {
  detail::write_last_word(record, end, text);
  memory.drain_stores();
}

}  // namespace iog::board
