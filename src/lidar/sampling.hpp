// Selects a sample of a packet's points. The sample contains the requested layers of firings that
// are spread evenly over the packet. In a firing, all layers of a unit measure at roughly the same
// azimuth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::lidar {

struct Sampling {
  std::span<const std::uint8_t> layers{};
  int log2_firings = 0;  // log2 of the number of firings; all firings if the packet has no more

  // Calls visit(firing) with the number of each sampled firing, in ascending order.
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
