// The filter beside Kalman's equations in floating point.
#include "objects/covariance.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::objects {
namespace {

using iog::tests::Random;

struct Reference {
  double place = 0;
  double both = 0;
  double speed = 0;

  void predict(double s, double wander) {
    place += 2 * s * both + s * s * speed;
    both += s * speed;
    speed += wander * wander * s;
  }
  Covariance::Gain measure(double variance) {
    const double k = place / (place + variance);
    const double l = both / (place + variance);
    speed -= l * both;
    both -= k * both;
    place -= k * place;
    return {.place = static_cast<std::int32_t>(std::round(k * 65'536)),
            .speed = static_cast<std::int32_t>(std::round(l * 65'536))};
  }
};

TEST(Covariance, IsThatOfKalman) {
  Random random(5);
  for (int run = 0; run < 100; ++run) {
    Covariance covariance(10'000, 0, 100'000'000);
    Reference reference{10'000, 0, 1e8};
    for (int frame = 0; frame < 100; ++frame) {
      const std::int32_t ms = random.between(10, 100);
      covariance.predict(Step(ms), 1'500);
      reference.predict(ms * 1e-3, 1'500);
      if (!random.one_in(4)) {
        const std::int32_t variance = random.between(2'000, 100'000);
        const Covariance::Gain gain = covariance.measure(variance);
        const Covariance::Gain expected = reference.measure(variance);
        ASSERT_NEAR(gain.place, expected.place, 70);
        ASSERT_NEAR(gain.speed, expected.speed, 0.01 * std::abs(expected.speed) + 300);
      }
      ASSERT_NEAR(covariance.place(), reference.place, 0.01 * reference.place + 10);
      ASSERT_NEAR(covariance.speed(), reference.speed, 0.01 * reference.speed + 2'000);
    }
  }
}

// Nothing overflows, whatever is measured or not for however long.
TEST(Covariance, StaysWithinItsBounds) {
  Random random(6);
  Covariance covariance(10'000, 0, 100'000'000);
  for (int i = 0; i < 20'000; ++i) {
    covariance.predict(Step(random.between(1, 450)), random.between(0, 100'000));
    if (random.one_in(50)) {
      const Covariance::Gain gain = covariance.measure(random.between(1, 2'000'000'000));
      ASSERT_GE(gain.place, 0);
      ASSERT_LE(gain.place, 65'536);
    }
    ASSERT_GE(covariance.place(), kLeastVariance);
    ASSERT_LE(covariance.place(), Covariance::kMost);
    ASSERT_GE(covariance.speed(), 0);
    ASSERT_LE(covariance.speed(), Covariance::kMost);
  }
}

}  // namespace
}  // namespace iog::objects
