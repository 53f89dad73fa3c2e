// What a target says of its signed commands (docs/spec.md 3.7 and 9).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "authentication/secured_message.hpp"
#include "stream/message.hpp"

namespace iog::tools {

// Poses, then maps.
struct CommandCounts {
  struct One {
    std::array<std::uint32_t, authentication::kVerdictCount> verdicts{};
    std::uint32_t counter = 0;  // of the last authentic message
  };
  std::array<One, 2> kinds{};
  std::uint32_t run = 0;                     // of the target
  std::array<std::uint32_t, 2> signature{};  // what it says has this MAC

  // Whether the target has said it, or anybody else who has the key.
  [[nodiscard]] bool is_signed_with(const authentication::Key& key) const;
  // What the next message has to be newer than, of whichever kind.
  [[nodiscard]] authentication::Freshness freshness() const;
};

// Nothing: the target does not want its commands signed.
[[nodiscard]] std::optional<CommandCounts> command_counts_of(const stream::FrameEnd& end,
                                                             std::uint32_t run);

// "poses 120 authentic, 3 unsigned; maps none; freshness 1a2b3c4d:120"
[[nodiscard]] std::string words_of(const CommandCounts& counts);

}  // namespace iog::tools
