#include "tools/clouds/head.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr double kShortestTurnUs = 45'000;
constexpr double kLongestTurnUs = 220'000;

}  // namespace

Head::Head(std::vector<ForwardTime> forward, const std::string& path)
    : forward_(std::move(forward)) {
  if (forward_.size() < 2) {
    throw UsageError(path + ": a drive has at least two turns, and here are " +
                     std::to_string(forward_.size()));
  }
  for (std::size_t i = 0; i + 1 < forward_.size(); ++i) {
    const ForwardTime& from = forward_[i];
    const ForwardTime& to = forward_[i + 1];
    const auto took_us = static_cast<double>(static_cast<std::int64_t>(to.time_us - from.time_us));
    const double turn_us = took_us / static_cast<double>(to.turn - from.turn);
    if (!(turn_us >= kShortestTurnUs && turn_us <= kLongestTurnUs)) {
      throw UsageError(path + ":" + std::to_string(to.turn + 1) + ": " +
                       std::to_string(static_cast<std::int64_t>(turn_us / 1000)) +
                       " ms a turn since the time before; a unit takes 50 to 200 ms");
    }
    stretches_.push_back({.turns = static_cast<double>(from.turn),
                          .time_us = static_cast<double>(from.time_us - forward_.front().time_us),
                          .turn_us = turn_us});
  }
}

// The last one that has begun, or else the first.
template <typename Value>
const Head::Stretch& Head::stretch_of(double value, Value Stretch::*member) const {
  const auto after = std::ranges::upper_bound(stretches_, value, {}, member);
  return after == stretches_.begin() ? stretches_.front() : *std::prev(after);
}

double Head::time_at(double turns) const {
  const Stretch& on = stretch_of(turns, &Stretch::turns);
  return on.time_us + (turns - on.turns) * on.turn_us;
}

double Head::turns_at(double time_us) const {
  const Stretch& on = stretch_of(time_us, &Stretch::time_us);
  return on.turns + (time_us - on.time_us) / on.turn_us;
}

}  // namespace iog::tools
