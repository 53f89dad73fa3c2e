#include "tools/receive/core_shares.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace iog::tools {

std::optional<CoreShares> core_shares_of(const stream::FrameEnd& end) {
  constexpr std::size_t kCounters = 2 + hal::kMaxCores;
  if (end.link_counter_count < stream::kCoreCounters + kCounters) {
    return std::nullopt;
  }
  const auto counters = std::span(end.link_counters).subspan<stream::kCoreCounters, kCounters>();
  CoreShares shares{.at_work = counters[0], .for_lost = counters[1]};
  std::ranges::copy(counters.last<hal::kMaxCores>(), shares.items.begin());
  return shares;
}

std::string words_of(const CoreShares& shares) {
  std::string text = std::to_string(shares.at_work);
  const std::uint64_t all =
      std::accumulate(shares.items.begin(), shares.items.end(), std::uint64_t{0});
  if (shares.at_work > 1 && all > 0) {
    text += ", with";
    for (std::size_t core = 0; core < shares.items.size(); ++core) {
      const std::uint64_t percent = (100 * std::uint64_t{shares.items[core]} + all / 2) / all;
      text += (core == 0 ? " " : ", ") + std::to_string(percent);
    }
    text += " % of the shared items";
  }
  if (shares.for_lost > 0) {
    text += ", " + std::to_string(shares.for_lost) + " done for lost cores";
  }
  return text;
}

}  // namespace iog::tools
