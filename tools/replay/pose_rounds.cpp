#include "tools/replay/pose_rounds.hpp"

namespace iog::tools {
namespace {

// Runs within one recording are mostly numbered one after the other, and differ by less.
constexpr std::uint32_t kRunsApart = 0x1'0000;

}  // namespace

std::vector<std::byte> PoseRounds::in_round(std::vector<std::byte> datagram) {
  const std::uint32_t rounds = rounds_before_ + (round_ > 1 ? round_ - 1 : 0);
  if (rounds == 0) {
    return datagram;
  }
  auto [fate, message] = pose::decode(datagram);
  if (fate != pose::Fate::kUsed) {
    return datagram;
  }
  message.run += rounds * kRunsApart;
  const auto bytes = encoder_.encode(message);
  return {bytes.begin(), bytes.end()};
}

}  // namespace iog::tools
