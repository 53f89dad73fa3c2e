#include "tools/receive/loop_times.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace iog::tools {
namespace {

// "< 4096", of the last ">= 65536".
std::string words_of_bucket(std::size_t bucket) {
  constexpr std::size_t kLast = health::Durations::kBuckets - 1;
  const std::uint32_t below_us = health::Durations::kFirstBelowUs << std::min(bucket, kLast - 1);
  return (bucket == kLast ? ">= " : "< ") + std::to_string(below_us);
}

}  // namespace

std::uint64_t LoopTime::count() const {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

double LoopTime::mean_us() const {
  const std::uint64_t all = count();
  return all == 0 ? 0 : static_cast<double>(sum_us) / static_cast<double>(all);
}

std::optional<LoopTimes> loop_times_of(const stream::FrameEnd& end) {
  constexpr std::size_t kCounters = stream::kTimeRows * stream::kTimeRowCounters;
  if (end.link_counter_count < stream::kTimeCounters + kCounters) {
    return std::nullopt;
  }
  LoopTimes times;
  auto row = std::span(end.link_counters).subspan(stream::kTimeCounters);
  for (LoopTime& time : times) {
    time.worst_us = row[0];
    time.sum_us = std::uint64_t{row[1]} << 32 | row[2];
    std::ranges::copy(row.subspan(3, time.counts.size()), time.counts.begin());
    row = row.subspan(stream::kTimeRowCounters);
  }
  return times;
}

std::string words_of(const LoopTime& time) {
  const std::uint64_t all = time.count();
  std::string text = std::to_string(std::llround(time.mean_us())) + " us mean, " +
                     std::to_string(time.worst_us) + " worst, of " + std::to_string(all);
  for (std::size_t i = 0; i < time.counts.size(); ++i) {
    if (time.counts[i] > 0) {
      const std::uint64_t percent = (100 * std::uint64_t{time.counts[i]} + all / 2) / all;
      text += (text.find('%') == std::string::npos ? ": " : ", ") + std::to_string(percent) +
              " % " + words_of_bucket(i);
    }
  }
  return text;
}

}  // namespace iog::tools
