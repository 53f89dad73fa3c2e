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
  static constexpr std::size_t kDirections = 120;  // of 3 degrees each
  using Directions = std::bitset<kDirections>;

  // Takes the next cloud in order of time.
  void take(const std::vector<WirePoint>& points);

  // Clouds that have hardly any direction in common with the one before. Only those count that fill
  // an arc with points.
  [[nodiscard]] std::uint64_t parts() const { return parts_; }

 private:
  Directions before_{};
  std::size_t points_before_ = 0;
  std::uint64_t parts_ = 0;
};

}  // namespace iog::tools
