#include "placing/hit_eights.hpp"

namespace iog::placing {

std::uint32_t hit_eights(const std::int8_t* band) {
  std::uint32_t hit = 0;
  for (std::size_t i = 0; i < kEightsPerBand; ++i) {
    const bool is_hit =
        lanes::EightBytes::load(band + i * lanes::EightBytes::kCount).has_positive();
    hit |= (is_hit ? 1U : 0U) << i;
  }
  return hit;
}

}  // namespace iog::placing
