// A record in DDR that a run leaves for the next run. No reset clears the record, and no boot
// loader overwrites it. The record also contains the run number, by which receivers distinguish
// runs (hal/run_number.hpp).
//
// After power-up, the content of DDR is arbitrary, so a record is valid only if its seal matches
// its content. The record's region is mapped uncached, and every function that writes the record
// ends with drain_stores() of the board's Memory. The data is therefore in memory when the function
// returns.
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
  std::uint32_t run_number;  // of the last run that had one; 0 if none since the cold start
  std::uint32_t cause;       // hal::EndCause of a last word
  std::uint32_t detail;      // of its hal::End
  std::uint32_t last_word_bytes;
  std::array<char, kLastWordBytes> last_word;
};

// The record, at an address of linker/<board>.ld. The record is deliberately never initialised.
extern "C" BootRecord boot_record;

// The DDR after the record is never written, so it keeps its content from power-up.
// NOLINTNEXTLINE(readability-identifier-naming): a symbol of the linker script
extern "C" const std::array<std::uint32_t, 1024> boot_noise;

// Information about the previous run.
struct Boot {
  hal::RunBefore before{};
  std::uint32_t last_word_bytes = 0;
  std::array<char, BootRecord::kLastWordBytes> last_word{};

  std::string_view last_word_text() const { return {last_word.data(), last_word_bytes}; }
};

// Data that differs between cold starts. Read this data after the board has started.
struct Differences {
  // The content of DDR after power-up. Some cells are random. All other cells may always have the
  // same content.
  std::span<const std::uint32_t> noise{};
  std::uint32_t ticks = 0;  // of a fast clock, after waiting for other clocks
  std::array<std::uint8_t, 6> mac{};
};

namespace detail {
Boot open(BootRecord& record);
std::uint32_t begin_run(BootRecord& record, const Differences& differences);
void write_last_word(BootRecord& record, hal::End end, std::string_view text);
}  // namespace detail

// Reads the record once, clears the record's last word, and counts this boot.
template <typename Memory>
Boot open_boot_record(BootRecord& record, Memory& memory) {
  const Boot boot = detail::open(record);
  memory.drain_stores();
  return boot;
}

// Returns the number of this run, which is never 0. The number is the number of the previous run
// plus 1. If the record has no number, the number of this run is a hash of all differences.
template <typename Memory>
std::uint32_t begin_run(BootRecord& record, const Differences& differences, Memory& memory) {
  const std::uint32_t number = detail::begin_run(record, differences);
  memory.drain_stores();
  return number;
}

// Stores a last word for the next boot. The text must not be empty, and is truncated to the
// available space.
template <typename Memory>
void write_last_word(BootRecord& record, hal::End end, std::string_view text, Memory& memory) {
  detail::write_last_word(record, end, text);
  memory.drain_stores();
}

}  // namespace iog::board
