// What the target counts of itself (docs/spec.md 3.7), in words. stream::counts_of() has it.
#pragma once

#include <cstdint>
#include <string>

#include "app/loop_times.hpp"
#include "authentication/command_counts.hpp"
#include "hal/end_of_run.hpp"
#include "health/durations.hpp"
#include "stream/message.hpp"
#include "work/team.hpp"

namespace iog::tools {

// "4, with 31, 23, 24, 22 % of the shared items", and how many were done for lost cores.
[[nodiscard]] std::string words_of(const work::TeamCounts& shares);

using LoopTimes = app::LoopTimes::Counts;
[[nodiscard]] double mean_us(const health::Durations& time);
// "2310 us mean, 4120 worst, of 250: 3 % < 2048, 96 % < 4096, 1 % < 8192".
[[nodiscard]] std::string words_of(const health::Durations& time);

// "3 since power-up; before: memory has changed, region 1". Of the first start "1 since power-up".
[[nodiscard]] std::string words_of(const hal::RunBefore& before);

// Of signed commands (docs/spec.md 9). run: the target's.
using authentication::CommandCounts;
// Whether the target has said it, or anybody else who has the key.
[[nodiscard]] bool is_signed_with(const authentication::Key& key, const CommandCounts& counts,
                                  std::uint32_t run);
// What the next message has to be newer than, of whichever kind.
[[nodiscard]] authentication::Freshness freshness_of(const CommandCounts& counts,
                                                     std::uint32_t run);
// "signed; poses 120 authentic, 3 unsigned; maps none; freshness 1a2b3c4d:120"
[[nodiscard]] std::string words_of(const CommandCounts& counts, std::uint32_t run);

}  // namespace iog::tools
