// Table 4.3 of the thesis (docs/model.md section 4).
#include "sensor_model/profile.hpp"

#include <gtest/gtest.h>

namespace iog::sensor_model {
namespace {

constexpr Profile kBlurred = make_profile({});
constexpr Profile kNearest = make_profile({.quantisation = index::Quantisation::kNearest});

TEST(Profile, TheProbabilitiesOfTable43) {
  const SingleTarget lux{0.10, 0.10};
  EXPECT_NEAR(lux.probability(-2), 0.185, 0.0005);
  EXPECT_NEAR(lux.probability(-1), 0.480, 0.0005);
  EXPECT_NEAR(lux.probability(0), 0.604, 0.0005);
  EXPECT_NEAR(lux.probability(1), 0.542, 0.0005);
  EXPECT_NEAR(lux.probability(2), 0.505, 0.0005);
}

// k-4 ... k+3
TEST(Profile, TheIndexesOfTable43) {
  constexpr std::array kBlurring{-14, -14, -7, 0, 2, 0, 0, 0};
  constexpr std::array kNearestIndexes{-15, -15, -7, 0, 2, 1, 0, 0};
  for (int i = 0; i < 8; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    EXPECT_EQ(int{kBlurred.at(i - 4)}, kBlurring[slot]) << "k" << i - 4;
    EXPECT_EQ(int{kNearest.at(i - 4)}, kNearestIndexes[slot]) << "k" << i - 4;
  }
  EXPECT_EQ(int{kBlurred.at(-500)}, -14);
  EXPECT_EQ(int{kNearest.at(500)}, 0);
}

// Only the ratio of cell length and sigma matters, so a VLP-16 of 3 cm has the LUX's profile.
TEST(Profile, ScalesWithThePrecision) {
  constexpr Profile kVlp16 = make_profile({.sigma_m = 0.03, .cell_length_m = 0.03});
  EXPECT_EQ(kVlp16, kBlurred);
}

TEST(Profile, ACellTooShortForItsSensorIsRefused) {
  constexpr Profile kTooShort = make_profile({.sigma_m = 0.1, .cell_length_m = 0.05});
  EXPECT_FALSE(kTooShort.is_valid());
  EXPECT_TRUE(kBlurred.is_valid());
  EXPECT_TRUE(kNearest.is_valid());
}

TEST(Profile, ALowerFloorSaysEmptierThings) {
  constexpr Profile kLower = make_profile({.floor = 0.01});
  EXPECT_LT(kLower.free, kBlurred.free);
  EXPECT_EQ(kLower.hit, kBlurred.hit);
}

}  // namespace
}  // namespace iog::sensor_model
