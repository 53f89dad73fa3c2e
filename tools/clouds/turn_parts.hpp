// Detects clouds that are parts of a spinning unit's turns.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/formats/points/points_writer.hpp"

namespace iog::tools {

class TurnParts {
 public:
  // Takes the next cloud in order of time.
  void take(const std::vector<WirePoint>& points);

  // Clouds that have hardly a direction in common with the one before. A part of a turn with few
  // points does not count.
  [[nodiscard]] std::uint64_t parts() const { return parts_; }

 private:
  // Of 3 degrees each.
  static constexpr std::size_t kDirections = 120;

  std::bitset<kDirections> before_{};
  std::uint64_t parts_ = 0;
};

}  // namespace iog::tools
