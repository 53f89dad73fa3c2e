#include "tools/clouds/cloud_order.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

// Whether `time_us` is far behind `other_us`.
bool is_far(std::uint64_t time_us, std::uint64_t other_us) {
  return time_us < other_us && other_us - time_us > CloudOrder::kMostDisorderUs;
}

[[noreturn]] void tell_step_back(std::uint64_t cloud, std::uint64_t from_us, std::uint64_t to_us) {
  std::ostringstream text;
  const auto put = [&](std::uint64_t time_us) {
    text << time_us / 1'000'000 << '.' << std::setw(6) << std::setfill('0') << time_us % 1'000'000
         << " s";
  };
  text << "from cloud " << cloud << " on, time goes back from ";
  put(from_us);
  text << " to ";
  put(to_us);
  text << ": give files in order of time, and split a recording where its clock was set back";
  throw UsageError(text.str());
}

}  // namespace

bool CloudOrder::is_far_behind(std::uint64_t time_us) const {
  return newest_us_ && is_far(time_us, *newest_us_);
}

void CloudOrder::release(SeenCloud&& cloud, std::vector<SeenCloud>& in_order) {
  newest_us_ = cloud.time_us;
  follows_stray_ = false;
  in_order.push_back(std::move(cloud));
}

// It waits because it is the first, or far ahead of or behind those in order.
void CloudOrder::judge_waiting(const SeenCloud& next, std::vector<SeenCloud>& in_order) {
  SeenCloud cloud = *std::exchange(waiting_, std::nullopt);
  const bool was_behind = is_far_behind(cloud.time_us);
  const bool is_next_behind = is_far_behind(next.time_us);
  const bool goes_back = is_far(next.time_us, cloud.time_us);
  if (was_behind && is_next_behind) {
    tell_step_back(taken_ - 1, *newest_us_, cloud.time_us);
  }
  if (!was_behind && (!goes_back || is_next_behind)) {
    release(std::move(cloud), in_order);
    return;
  }
  if (std::exchange(follows_stray_, true)) {
    tell_step_back(taken_, cloud.time_us, next.time_us);
  }
  ++strays_;
}

std::vector<SeenCloud> CloudOrder::take(SeenCloud&& cloud) {
  std::vector<SeenCloud> in_order;
  if (waiting_) {
    judge_waiting(cloud, in_order);
  }
  const std::uint64_t time_us = cloud.time_us;
  if (!newest_us_ || is_far_behind(time_us) || is_far(*newest_us_, time_us)) {
    waiting_ = std::move(cloud);
  } else if (time_us < *newest_us_) {
    ++out_of_order_;
    furthest_back_us_ = std::max(furthest_back_us_, *newest_us_ - time_us);
    follows_stray_ = false;
  } else {
    release(std::move(cloud), in_order);
  }
  ++taken_;
  return in_order;
}

std::vector<SeenCloud> CloudOrder::finish() {
  std::vector<SeenCloud> in_order;
  if (waiting_) {
    SeenCloud cloud = *std::exchange(waiting_, std::nullopt);
    if (is_far_behind(cloud.time_us)) {
      ++strays_;
    } else {
      release(std::move(cloud), in_order);
    }
  }
  return in_order;
}

}  // namespace iog::tools
