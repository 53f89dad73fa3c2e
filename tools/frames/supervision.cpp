#include "tools/frames/supervision.hpp"

#include <algorithm>
#include <span>

namespace iog::protection {

ChannelState Supervisor::update(CheckStatus status) {
  state_ = next_state(status);
  return state_;
}

ChannelState Supervisor::next_state(CheckStatus status) {
  if (state_ == ChannelState::kNoData) {
    const bool is_sign_of_life = status != CheckStatus::kError && status != CheckStatus::kNoNewData;
    return is_sign_of_life ? ChannelState::kInit : ChannelState::kNoData;
  }
  const auto window = std::span(checks_).first(supervision_.window);
  window[oldest_] = status;
  oldest_ = oldest_ + 1 == window.size() ? 0 : oldest_ + 1;

  const Supervision::Limits& limits = state_ == ChannelState::kInit    ? supervision_.init
                                      : state_ == ChannelState::kValid ? supervision_.valid
                                                                       : supervision_.invalid;
  const bool is_faulty = std::ranges::count(window, CheckStatus::kError) > limits.max_errors;
  if (!is_faulty && std::ranges::count_if(window, is_usable) >= limits.min_ok) {
    return ChannelState::kValid;
  }
  const bool waits = state_ == ChannelState::kInit && !is_faulty;
  return waits ? ChannelState::kInit : ChannelState::kInvalid;
}

}  // namespace iog::protection
