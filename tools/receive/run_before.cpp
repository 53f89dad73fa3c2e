#include "tools/receive/run_before.hpp"

#include <array>
#include <span>
#include <string_view>

#include "tools/program/hexadecimal.hpp"

namespace iog::tools {
namespace {

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

}  // namespace

std::optional<hal::RunBefore> run_before_of(const stream::FrameEnd& end) {
  constexpr std::size_t kCounters = 3;
  if (end.link_counter_count < stream::kEndCounters + kCounters) {
    return std::nullopt;
  }
  const auto counters = std::span(end.link_counters).subspan<stream::kEndCounters, kCounters>();
  return hal::RunBefore{
      .starts = counters[0],
      .end = {.cause = static_cast<hal::EndCause>(counters[1]), .detail = counters[2]}};
}

std::string words_of(const hal::RunBefore& before) {
  std::string text = std::to_string(before.starts) + " since power-up";
  if (before.starts > 1) {
    text += "; before: " + words_of_end(before.end);
  }
  return text;
}

}  // namespace iog::tools
