// What a target's link counters say of it (docs/spec.md 3.7), and how that is called for a person.
// Nothing comes of a target that does not count it: a PC, or an older one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "authentication/secured_message.hpp"
#include "hal/cores.hpp"
#include "hal/end_of_run.hpp"
#include "health/durations.hpp"
#include "stream/message.hpp"
#include "tools/report/names.hpp"

namespace iog::tools {

// How the cores have shared the work.
struct CoreShares {
  std::uint32_t at_work = 0;
  std::uint32_t for_lost = 0;  // items that core 0 did again, or in another's place
  std::array<std::uint32_t, hal::kMaxCores> items{};
  friend bool operator==(const CoreShares&, const CoreShares&) = default;
};
[[nodiscard]] std::optional<CoreShares> core_shares_of(const stream::FrameEnd& end);
// "4, with 31, 23, 24, 22 % of the shared items", and how many were done for lost cores.
[[nodiscard]] std::string words_of(const CoreShares& shares);

// How long one thing of the loop took, since the target's start.
struct LoopTime {
  std::uint32_t worst_us = 0;
  std::uint64_t sum_us = 0;
  std::array<std::uint32_t, health::Durations::kBuckets> counts{};

  [[nodiscard]] std::uint64_t count() const;
  [[nodiscard]] double mean_us() const;
  friend bool operator==(const LoopTime&, const LoopTime&) = default;
};
using LoopTimes = std::array<LoopTime, kLoopTimeNames.size()>;
[[nodiscard]] std::optional<LoopTimes> loop_times_of(const stream::FrameEnd& end);
// "2310 us mean, 4120 worst, of 250: 3 % < 2048, 96 % < 4096, 1 % < 8192".
[[nodiscard]] std::string words_of(const LoopTime& time);

// How often the target has started, and how the run before this one has ended.
[[nodiscard]] std::optional<hal::RunBefore> run_before_of(const stream::FrameEnd& end);
// "3 since power-up; before: memory has changed, region 1". Of the first start "1 since power-up".
[[nodiscard]] std::string words_of(const hal::RunBefore& before);

// Of signed commands (docs/spec.md 9): poses, then maps.
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
// Nothing also of a target that does not want its commands signed.
[[nodiscard]] std::optional<CommandCounts> command_counts_of(const stream::FrameEnd& end,
                                                             std::uint32_t run);
// "poses 120 authentic, 3 unsigned; maps none; freshness 1a2b3c4d:120"
[[nodiscard]] std::string words_of(const CommandCounts& counts);

}  // namespace iog::tools
