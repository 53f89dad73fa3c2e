// How the target's cores have shared its work, as the link counters say it (docs/spec.md 3.7).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hal/cores.hpp"
#include "stream/message.hpp"

namespace iog::tools {

struct CoreShares {
  std::uint32_t at_work = 0;
  std::uint32_t for_lost = 0;  // items that core 0 did again, or in another's place
  std::array<std::uint32_t, hal::kMaxCores> items{};
  friend bool operator==(const CoreShares&, const CoreShares&) = default;
};

// Empty if the target does not say it: a PC, or an older one.
[[nodiscard]] std::optional<CoreShares> core_shares_of(const stream::FrameEnd& end);

// "4, with 31, 23, 24, 22 % of the shared items", and how many were done for lost cores.
[[nodiscard]] std::string words_of(const CoreShares& shares);

}  // namespace iog::tools
