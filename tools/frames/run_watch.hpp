// Which run of a target is the newest, by the numbers in its messages (docs/spec.md 3.2).
//
// The first run that is heard of is believed at once. Another one replaces it when three different
// messages of it have come and none of the newest run between them; so one that has strayed ends no
// stream. A run that has been replaced never comes back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "stream/message.hpp"

namespace iog::tools {

class RunWatch {
 public:
  static constexpr std::size_t kConfirmations = 3;

  enum class Verdict : std::uint8_t {
    kNewest,       // of the newest run
    kUnconfirmed,  // of a run that is new, perhaps; kept
    kReplaces,     // its run is the newest from now on: take_kept() has its first messages
    kReplaced,     // of a run that is over
  };
  // `content` is the message's, from its header on.
  [[nodiscard]] Verdict arrive(const stream::Header& header, std::span<const std::byte> content);

  // After kReplaces, once: this message and those before it, in the order in which they were sent.
  [[nodiscard]] std::vector<std::vector<std::byte>> take_kept();

 private:
  // As many restarts ago a run is forgotten. Nobody but a target that cannot start gets there.
  static constexpr std::size_t kMaxReplaced = 4096;

  std::optional<std::uint32_t> newest_;
  std::deque<std::uint32_t> replaced_;
  std::uint32_t candidate_ = 0;
  std::map<std::uint32_t, std::vector<std::byte>> kept_;  // of the candidate, by sequence number
};

}  // namespace iog::tools
