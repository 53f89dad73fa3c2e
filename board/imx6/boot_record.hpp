// What a run leaves to the next one: a record in DDR that no reset clears and no loader overwrites.
//
// After power-up DDR holds anything, so a record counts only if its seal fits its contents. The
// region is mapped uncached. So what is written is in memory even if nothing is left that could
// clean a cache.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace iog::imx6 {

enum class BootReason : std::uint8_t {
  kColdStart,      // there was no record
  kAfterLastWord,  // the previous run ended with a last word
  kWithoutAWord,   // the previous run was reset while it seemed alive: its watchdog, or the button
};

struct BootRecord {
  static constexpr std::size_t kLastWordBytes = 240;

  std::uint32_t seal;
  std::uint32_t boots;  // since the cold start
  std::uint32_t last_word_bytes;
  std::array<char, kLastWordBytes> last_word;
};

// The record, at an address of linker/imx6.ld. It is deliberately never initialised.
extern "C" BootRecord boot_record;  // NOLINT(bugprone-dynamic-static-initializers)

// What a boot learns about the run before it.
struct Boot {
  BootReason reason = BootReason::kColdStart;
  std::uint32_t number = 1;  // 1 for a cold start
  std::uint32_t last_word_bytes = 0;
  std::array<char, BootRecord::kLastWordBytes> last_word{};

  std::string_view last_word_text() const { return {last_word.data(), last_word_bytes}; }
};

// Reads the record once, removes its last word and counts this boot.
Boot open_boot_record(BootRecord& record);

// Leaves a last word for the next boot; it is cut to the space there is.
void write_last_word(BootRecord& record, std::string_view text);

}  // namespace iog::imx6
