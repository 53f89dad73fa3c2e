// Whether the road that a car's spinning lidars see is where the car's file says.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tools/mount/unit_turns.hpp"

namespace iog::tools {

class MountWatch {
 public:
  // The car outlives it. Of so many turns, one is looked at.
  explicit MountWatch(const CatalogueEntry& car, std::uint64_t every = 5);

  // The next datagram of the capture.
  void take(const CapturedDatagram& datagram);
  // A row of a table for each mount that is clearly wrong. The capture is over.
  [[nodiscard]] std::string rows();

 private:
  std::vector<std::pair<const description::SensorConfig*, UnitTurns>> units_;
};

}  // namespace iog::tools
