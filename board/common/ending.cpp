#include "ending.hpp"

#include "helper.hpp"
#include "machine.hpp"
#include "require/require.hpp"

namespace iog::board {
namespace {

constinit bool ending = false;

}  // namespace

void end_with_last_word(hal::End end, std::string_view text) {
  // A fault while reporting a fault says nothing more: the first word is the one that counts.
  if (!ending) {
    ending = true;
    // Recorded before it is printed, because recording cannot block.
    record_last_word(end, text);
    print_last_word(text);
  }
  wait_for_reset();
}

void end_core(hal::End end, const TextLine& last_word) {
  if (machine::core_number() != 0) {
    end_helper(hal::CoreState::kFaulted, last_word);
  }
  end_with_last_word(end, last_word.view());
}

std::string_view reason_of(hal::EndCause cause) {
  switch (cause) {
    case hal::EndCause::kPowerUp:
      return "cold start";
    case hal::EndCause::kWithoutAWord:
      return "reset without a word";
    default:
      return "reset after a last word";
  }
}

std::string_view words_of(hal::EndCause cause) {
  switch (cause) {
    case hal::EndCause::kMemory:
      return "memory has changed";
    case hal::EndCause::kLate:
      return "silent";
    default:
      return "the run ended";
  }
}

}  // namespace iog::board

// What a broken requirement of the core or of a driver does on a board (src/require/).
void iog::programmer_error(const char* file, int line) {
  board::TextLine text;
  text.text("requirement broken at ").text(file).text(":");
  text.decimal(static_cast<std::uint32_t>(line));
  board::end_core(
      {.cause = hal::EndCause::kRequirement, .detail = static_cast<std::uint32_t>(line)}, text);
}
