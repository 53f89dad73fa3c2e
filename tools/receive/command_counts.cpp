#include "tools/receive/command_counts.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "stream/channel.hpp"
#include "tools/program/hexadecimal.hpp"

namespace iog::tools {
namespace {

constexpr std::array<std::string_view, authentication::kVerdictCount> kVerdictNames{
    "authentic", "unsigned", "replayed", "forged"};

std::string words_of(const CommandCounts::One& kind) {
  std::string words;
  for (std::size_t i = 0; i < kVerdictNames.size(); ++i) {
    if (kind.verdicts.at(i) > 0) {
      words += (words.empty() ? "" : ", ") + std::to_string(kind.verdicts.at(i)) + " " +
               std::string(kVerdictNames.at(i));
    }
  }
  return words.empty() ? "none" : words;
}

}  // namespace

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
  constexpr std::size_t kOfOne = authentication::kVerdictCount + 1;
  if (end.link_counter_count < stream::kCommandCounters + 2 * kOfOne + 2) {
    return std::nullopt;
  }
  auto counters = std::span(end.link_counters).subspan(stream::kCommandCounters);
  CommandCounts counts{.run = run};
  for (CommandCounts::One& kind : counts.kinds) {
    std::ranges::copy(counters.first<authentication::kVerdictCount>(), kind.verdicts.begin());
    kind.counter = counters[authentication::kVerdictCount];
    counters = counters.subspan(kOfOne);
  }
  std::ranges::copy(counters.first<2>(), counts.signature.begin());
  return counts;
}

std::string words_of(const CommandCounts& counts) {
  return "signed; poses " + words_of(counts.kinds[0]) + "; maps " + words_of(counts.kinds[1]) +
         "; freshness " + hex(counts.run) + ":" + std::to_string(counts.freshness().counter);
}

}  // namespace iog::tools
