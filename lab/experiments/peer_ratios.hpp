// The ratios of times on a PC that docs/peers.md holds against its goals; compiled in.
#pragma once

#include <string>
#include <vector>

namespace iog::lab {

struct PeerRatio {
  std::string peer;
  std::string what;  // of a frame was timed
  double goal = 0;   // at least so many times our time
  double city = 0;
  double ring_road = 0;
};

// std::out_of_range if the page has no such table.
[[nodiscard]] std::vector<PeerRatio> peer_ratios();

}  // namespace iog::lab
