// The poses of a recording that is played again and again: each round is another run of their
// source, because its clock goes back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pose/message.hpp"

namespace iog::tools {

class PoseRounds {
 public:
  // rounds_before: of the same recording, by whoever has played it to the same target.
  explicit PoseRounds(std::uint32_t rounds_before = 0) : rounds_before_(rounds_before) {}

  // The recording begins once more.
  void start_round() { ++round_; }

  // A datagram for the poses' port as it is sent in this round. The very first one changes nothing;
  // what is no sound message stays as it is, too.
  [[nodiscard]] std::vector<std::byte> in_round(std::vector<std::byte> datagram);

 private:
  std::uint32_t rounds_before_;
  std::uint32_t round_ = 0;  // 0: none has begun
  pose::Encoder encoder_;
};

}  // namespace iog::tools
