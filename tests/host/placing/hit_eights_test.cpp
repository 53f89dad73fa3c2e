// An eight is hit if one of its bytes is above zero.
#include "placing/hit_eights.hpp"

#include <array>
#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::placing {
namespace {

TEST(HitEights, AreThoseWithAByteAboveZero) {
  tests::Random random(11);
  for (int round = 0; round < 500; ++round) {
    alignas(8) std::array<std::int8_t, 256> band{};
    const int one_hit_in = random.between(2, 60);
    std::uint32_t expected = 0;
    for (std::size_t i = 0; i < band.size(); ++i) {
      const bool is_hit = random.one_in(one_hit_in);
      band[i] = static_cast<std::int8_t>(is_hit ? random.between(1, 127) : random.between(-128, 0));
      expected |= (is_hit ? 1U : 0U) << i / 8;
    }
    ASSERT_EQ(hit_eights(band.data()), expected) << round;
  }
}

}  // namespace
}  // namespace iog::placing
