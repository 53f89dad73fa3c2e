// What the classes say of things that stop.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "lab/evaluation/perception.hpp"
#include "lab/experiments/perception/scores.hpp"

namespace iog::lab {

// The hits of one frame on a thing that has stopped.
struct StopFrame {
  double since_s = 0;
  std::uint64_t cells = 0;
  std::uint64_t standing = 0;  // those that are called standing
};

// A thing that stopped after it had moved, and what its hits were called from then on, by half
// seconds.
struct Stop {
  static constexpr std::size_t kHalfSeconds = 10;  // the last: and later
  std::uint32_t thing = 0;
  bool is_car = false;
  double stopped_s = 0;
  std::array<SaidCounts, kHalfSeconds> by_half_second{};
  std::vector<StopFrame> frames{};
};

class StreetWatch {
 public:
  // Of the first rule. Frames are scored frames, one after another.
  void add(const PerceivedFrame& frame, const FrameTruth& truth);

  [[nodiscard]] const std::vector<Stop>& stops() const { return stops_; }

 private:
  struct Follow {
    TrueState state = TrueState::kNothing;
    std::size_t stop = 0;  // its place in stops_, more by one; 0: it has not stopped yet
  };
  void follow_states(double time_s, const TrueThings& things);
  void add_hits(double time_s, const PerceivedFrame& frame, const FrameTruth& truth);

  std::map<std::uint32_t, Follow> things_;
  std::vector<Stop> stops_;
};

}  // namespace iog::lab
