#include "tools/replay/pace.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "tools/program/interrupt.hpp"

namespace iog::tools {
namespace {

std::uint64_t now_us() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000U +
         static_cast<std::uint64_t>(now.tv_nsec) / 1000U;
}

}  // namespace

Pace::Pace(double speed) : speed_(speed) {}

void Pace::wait_for(std::uint64_t time_us) {
  if (speed_ <= 0) {
    return;
  }
  const auto scaled = static_cast<std::uint64_t>(static_cast<double>(time_us) / speed_);
  if (!has_started_) {
    has_started_ = true;
    start_us_ = now_us() - scaled;
  }
  const std::uint64_t due = start_us_ + scaled;
  timespec until{};
  until.tv_sec = static_cast<time_t>(due / 1'000'000U);
  until.tv_nsec = static_cast<long>(due % 1'000'000U * 1000U);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR &&
         !was_interrupted()) {
  }
  const std::uint64_t now = now_us();
  worst_delay_us_ = std::max(worst_delay_us_, now > due ? now - due : 0);
}

}  // namespace iog::tools
