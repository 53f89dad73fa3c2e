// How often the target has started, and how the run before this one has ended, as the link counters
// say it (docs/spec.md 3.7).
#pragma once

#include <optional>
#include <string>

#include "hal/end_of_run.hpp"
#include "stream/message.hpp"

namespace iog::tools {

// Empty if the target does not say it: a PC, or an older one.
[[nodiscard]] std::optional<hal::RunBefore> run_before_of(const stream::FrameEnd& end);

// "3 since power-up; before: memory has changed, region 1". Of the first start "1 since power-up".
[[nodiscard]] std::string words_of(const hal::RunBefore& before);

}  // namespace iog::tools
