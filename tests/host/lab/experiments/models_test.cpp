// What the results say of the thesis's tables 4.1 and 4.3 and figure 3.6 must be what it prints.
#include <algorithm>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

#include "lab/experiments/sections.hpp"

namespace iog::lab {
namespace {

Claim claim_on(const Section& section, const std::string& place, const std::string& what) {
  const auto found =
      std::find_if(section.claims.begin(), section.claims.end(), [&](const Claim& claim) {
        return claim.place == place && claim.what.find(what) != std::string::npos;
      });
  if (found == section.claims.end()) {
    throw std::out_of_range(place + " says nothing of " + what);
  }
  return *found;
}

bool has_text(const Section& section, const std::string& text) {
  return section.body.text().find(text) != std::string::npos;
}

// Equal to 1e-12, at 2 * 2^(N-1) configurations against 2 N terms for N = 18.
TEST(InverseSensorModelSection, FindsTheoremSixEqualToTheEnumerationAndCheaper) {
  const Section section = inverse_sensor_model({});
  const Claim equality = claim_on(section, "table 4.1", "Theorem 6");
  const std::string words = "difference below ";
  EXPECT_EQ(equality.verdict, Verdict::kEquals);
  ASSERT_EQ(equality.ours.rfind(words, 0), 0U);
  EXPECT_LE(std::stod(equality.ours.substr(words.size())), 1e-12);
  const Claim cost = claim_on(section, "table 4.1", "cost");
  EXPECT_EQ(cost.ours, "262,144 configurations against 36 terms");
  EXPECT_EQ(cost.verdict, Verdict::kEquals);
}

// The thesis, page 102.
TEST(ProfilesSection, HasTheIndexesOfTable43) {
  const Section section = profiles({});
  const Claim blurring = claim_on(section, "table 4.3", "blurring");
  EXPECT_EQ(blurring.paper, "-14, -7, 0, 2, 0, 0");
  EXPECT_EQ(blurring.ours, blurring.paper);
  EXPECT_EQ(blurring.verdict, Verdict::kEquals);
  const Claim nearest = claim_on(section, "table 4.3", "nearest");
  EXPECT_EQ(nearest.paper, "-15, -7, 0, 2, 1, 0");
  EXPECT_EQ(nearest.ours, nearest.paper);
  EXPECT_EQ(nearest.verdict, Verdict::kEquals);
}

// 0.05, 0.18, 0.48, 0.6, 0.54, 0.5.
TEST(ProfilesSection, HasTheProbabilitiesOfTable43) {
  const Section section = profiles({});
  EXPECT_EQ(claim_on(section, "table 4.3", "ISM").verdict, Verdict::kEquals);
  for (const std::string ism : {"0.05 | 0.0500", "0.18 | 0.1846", "0.48 | 0.4803", "0.60 | 0.6038",
                                "0.54 | 0.5420", "0.50 | 0.5051"}) {
    EXPECT_TRUE(has_text(section, " " + ism + " |")) << ism;
  }
}

// Contract section 4: only with the factor 1/2 does table 4.3 come out.
TEST(ProfilesSection, DepartsFromTheExponentOfEquation41) {
  EXPECT_EQ(claim_on(profiles({}), "equation 4.1", "exponent").verdict, Verdict::kDeparts);
}

// Theorem 6 puts every cell from k on above 1/2, where the thesis sees the maximum below.
TEST(ProfilesSection, DepartsFromTheMaximumOfFigure46d) {
  const Section section = profiles({});
  EXPECT_EQ(claim_on(section, "figure 4.6d", "largest").verdict, Verdict::kDeparts);
  EXPECT_EQ(claim_on(section, "figure 4.6b", "largest").verdict, Verdict::kEquals);
}

// Thesis section 3.4.6.3: 256 entries, so M = 127 and not more.
TEST(RecursiveSetsSection, NeedsTheTableThatTheThesisSays) {
  const Section section = recursive_sets({});
  EXPECT_EQ(claim_on(section, "section 3.4.6.3", "lookup table").ours, "255 are needed");
  for (const Claim& claim : section.claims) {
    EXPECT_EQ(claim.verdict, Verdict::kEquals) << claim.place << ", " << claim.what;
  }
}

}  // namespace
}  // namespace iog::lab
