// A few points of a packet that stand for all of them: of some layers, in some of its firings,
// which are spread evenly over it. A firing is all layers of a unit in one direction, once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::lidar {

struct Sampling {
  std::span<const std::uint8_t> layers{};
  int log2_firings = 0;  // so many of a packet, or all where it has no more

  // Calls visit(firing) with the numbers of those, in rising order.
  template <typename Visit>
  void for_each_firing(std::size_t firings, Visit&& visit) const {
    const std::size_t wanted = std::size_t{1} << log2_firings;
    const bool are_all = firings <= wanted;
    for (std::size_t i = 0; i < (are_all ? firings : wanted); ++i) {
      visit(are_all ? i : (2 * i + 1) * firings >> (log2_firings + 1));
    }
  }
};

}  // namespace iog::lidar
