#include "tools/report/counters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "stream/channel.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

using stream::Group;

// The counters of a group; empty if the target does not have them all.
template <Group kGroup>
std::span<const std::uint32_t> counters_of(const stream::FrameEnd& end) {
  constexpr std::size_t kBegin = stream::place_of(kGroup);
  constexpr std::size_t kCount = [] {
    std::size_t words = 0;
    for (const stream::Row& row : stream::table::kRows) {
      words += row.group == kGroup ? stream::words_of(row.kind) : 0;
    }
    return words;
  }();
  if (end.link_counter_count < kBegin + kCount) {
    return {};
  }
  return std::span(end.link_counters).subspan(kBegin, kCount);
}

// "< 4096", of the last ">= 65536".
std::string words_of_bucket(std::size_t bucket) {
  constexpr std::size_t kLast = health::Durations::kBuckets - 1;
  const std::uint32_t below_us = health::Durations::kFirstBelowUs << std::min(bucket, kLast - 1);
  return (bucket == kLast ? ">= " : "< ") + std::to_string(below_us);
}

// docs/spec.md 3.7.
constexpr std::array<std::string_view, 10> kMustLive{
    "datagrams",           "time",   "network", "serial line", "frames", "check of memory",
    "Ethernet controller", "core 1", "core 2",  "core 3"};

std::string words_of_silent(std::uint32_t bits) {
  std::string words;
  for (std::size_t i = 0; i < 32; ++i) {
    if ((bits >> i & 1U) != 0) {
      words += words.empty() ? "" : ", ";
      words += i < kMustLive.size() ? kMustLive.at(i) : "number " + std::to_string(i);
    }
  }
  return words;
}

// A number that this program does not know is of a later target.
std::string words_of_end(const hal::End& end) {
  const std::string detail = std::to_string(end.detail);
  switch (end.cause) {
    case hal::EndCause::kPowerUp:
      return "nothing is known";
    case hal::EndCause::kWithoutAWord:
      return "reset without a word";
    case hal::EndCause::kException:
      return "exception of the processor, kind " + detail;
    case hal::EndCause::kRequirement:
      return "requirement broken, line " + detail;
    case hal::EndCause::kMemory:
      return "memory has changed, region " + detail;
    case hal::EndCause::kLate:
      return "silent: " + words_of_silent(end.detail);
    case hal::EndCause::kHang:
      return "hung at 0x" + hex(end.detail);
  }
  return "cause " + std::to_string(static_cast<unsigned>(end.cause)) + ", " + detail;
}

std::string words_of(const CommandCounts::One& kind) {
  constexpr std::array<std::string_view, authentication::kVerdictCount> kNames{
      "authentic", "unsigned", "replayed", "forged"};
  return list_of(kind.verdicts, kNames);
}

}  // namespace

std::optional<CoreShares> core_shares_of(const stream::FrameEnd& end) {
  const auto counters = counters_of<Group::kCore>(end);
  if (counters.empty()) {
    return std::nullopt;
  }
  CoreShares shares{.at_work = counters[0], .for_lost = counters[1]};
  std::ranges::copy(counters.last<hal::kMaxCores>(), shares.items.begin());
  return shares;
}

std::string words_of(const CoreShares& shares) {
  std::string text = std::to_string(shares.at_work);
  const std::uint64_t all =
      std::accumulate(shares.items.begin(), shares.items.end(), std::uint64_t{0});
  if (shares.at_work > 1 && all > 0) {
    text += ", with ";
    for (std::size_t core = 0; core < shares.items.size(); ++core) {
      text += (core == 0 ? "" : ", ") + percent(shares.items[core], all);
    }
    text += " % of the shared items";
  }
  if (shares.for_lost > 0) {
    text += ", " + std::to_string(shares.for_lost) + " done for lost cores";
  }
  return text;
}

std::uint64_t LoopTime::count() const {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

double LoopTime::mean_us() const {
  const std::uint64_t all = count();
  return all == 0 ? 0 : static_cast<double>(sum_us) / static_cast<double>(all);
}

std::optional<LoopTimes> loop_times_of(const stream::FrameEnd& end) {
  auto row = counters_of<Group::kLoopTime>(end);
  if (row.empty()) {
    return std::nullopt;
  }
  LoopTimes times;
  for (LoopTime& time : times) {
    time.worst_us = row[0];
    time.sum_us = std::uint64_t{row[1]} << 32 | row[2];
    std::ranges::copy(row.subspan(3, time.counts.size()), time.counts.begin());
    row = row.subspan(stream::kDurationWords);
  }
  return times;
}

std::string words_of(const LoopTime& time) {
  const std::uint64_t all = time.count();
  std::string text = std::to_string(std::llround(time.mean_us())) + " us mean, " +
                     std::to_string(time.worst_us) + " worst, of " + std::to_string(all);
  std::string_view before = ": ";
  for (std::size_t i = 0; i < time.counts.size(); ++i) {
    if (time.counts[i] > 0) {
      text.append(before).append(percent(time.counts[i], all) + " % " + words_of_bucket(i));
      before = ", ";
    }
  }
  return text;
}

std::optional<hal::RunBefore> run_before_of(const stream::FrameEnd& end) {
  const auto counters = counters_of<Group::kRun>(end);
  if (counters.empty()) {
    return std::nullopt;
  }
  return hal::RunBefore{
      .starts = counters[0],
      .end = {.cause = static_cast<hal::EndCause>(counters[1]), .detail = counters[2]}};
}

std::string words_of(const hal::RunBefore& before) {
  return std::to_string(before.starts) + " since power-up" +
         (before.starts > 1 ? "; before: " + words_of_end(before.end) : "");
}

authentication::Freshness CommandCounts::freshness() const {
  return {.run = run, .counter = std::max(kinds[0].counter, kinds[1].counter)};
}

bool CommandCounts::is_signed_with(const authentication::Key& key) const {
  std::vector<std::uint32_t> counters;
  for (const One& kind : kinds) {
    counters.insert(counters.end(), kind.verdicts.begin(), kind.verdicts.end());
    counters.push_back(kind.counter);
  }
  return authentication::mac_of_counters(authentication::CmacKey(key),
                                         stream::kNetworkChannel.event.event_id, run,
                                         counters) == signature;
}

std::optional<CommandCounts> command_counts_of(const stream::FrameEnd& end, std::uint32_t run) {
  auto counters = counters_of<Group::kCommand>(end);
  if (counters.empty()) {
    return std::nullopt;
  }
  CommandCounts counts{.run = run};
  for (CommandCounts::One& kind : counts.kinds) {
    std::ranges::copy(counters.first<authentication::kVerdictCount>(), kind.verdicts.begin());
    kind.counter = counters[authentication::kVerdictCount];
    counters = counters.subspan(authentication::kVerdictCount + 1);
  }
  std::ranges::copy(counters.first<2>(), counts.signature.begin());
  return counts;
}

std::string words_of(const CommandCounts& counts) {
  return "signed; poses " + words_of(counts.kinds[0]) + "; maps " + words_of(counts.kinds[1]) +
         "; freshness " + hex(counts.run) + ":" + std::to_string(counts.freshness().counter);
}

}  // namespace iog::tools
