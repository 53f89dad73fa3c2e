#include "tools/report/counters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

#include "stream/channel.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

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

std::string words_of(const CommandCounts::OfOneKind& kind) {
  constexpr std::array<std::string_view, authentication::kVerdictCount> kNames{
      "authentic", "unsigned", "replayed", "forged"};
  return list_of(kind.verdicts, kNames);
}

}  // namespace

std::string words_of(const work::TeamCounts& shares) {
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

double mean_us(const health::Durations& time) {
  const std::uint64_t all = time.count();
  return all == 0 ? 0 : static_cast<double>(time.sum_us()) / static_cast<double>(all);
}

std::string words_of(const health::Durations& time) {
  const std::uint64_t all = time.count();
  std::string text = std::to_string(std::llround(mean_us(time))) + " us mean, " +
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

std::string words_of(const hal::RunBefore& before) {
  return std::to_string(before.starts) + " since power-up" +
         (before.starts > 1 ? "; before: " + words_of_end(before.end) : "");
}

authentication::Freshness freshness_of(const CommandCounts& counts, std::uint32_t run) {
  return {.run = run, .counter = std::max(counts.kinds[0].counter, counts.kinds[1].counter)};
}

bool is_signed_with(const authentication::Key& key, const CommandCounts& counts,
                    std::uint32_t run) {
  return counts.signature_by(authentication::CmacKey(key), stream::kNetworkChannel.event.event_id,
                             run) == counts.signature;
}

std::string words_of(const CommandCounts& counts, std::uint32_t run) {
  return "signed; poses " + words_of(counts.kinds[0]) + "; maps " + words_of(counts.kinds[1]) +
         "; freshness " + hex(run) + ":" + std::to_string(freshness_of(counts, run).counter);
}

}  // namespace iog::tools
