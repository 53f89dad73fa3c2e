// What the experiments find of the thesis's tables 4.1 and 4.3 and figures 3.6 and 4.6 must be what
// it prints.
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "lab/experiments/experiments.hpp"
#include "value_in.hpp"

namespace iog::lab {
namespace {

// Equal but for rounding, at 2 * 2^(N-1) configurations against 2 N terms.
TEST(InverseSensorModel, IsTheoremSixEqualToTheEnumerationAndCheaper) {
  const Tables tables = inverse_sensor_model({});
  for (int cells = 2; cells <= 18; ++cells) {
    const auto value = [&](const std::string& column) {
      return std::stod(
          value_in(tables, "inverse_sensor_model", column, {{"cells", std::to_string(cells)}}));
    };
    EXPECT_LE(value("difference_below"), 1e-12) << cells;
    EXPECT_EQ(value("configurations"), std::pow(2, cells)) << cells;
    EXPECT_EQ(value("terms"), 2 * cells) << cells;
  }
  for (const char* length : {"0.5", "1", "2", "4"}) {
    EXPECT_LE(std::stod(value_in(tables, "inverse_sensor_model_in_firmware", "difference_below",
                                 {{"cell_length_sigmas", length}})),
              1e-12)
        << length;
  }
}

// The thesis, page 102: an ISM with two digits, cut off or rounded.
TEST(Profiles, AreThoseOfTable43) {
  struct Column {
    const char* offset;
    double ism;
    const char* blurring;
    const char* nearest;
  };
  constexpr std::array<Column, 6> kTable43{{{"-3", 0.05, "-14", "-15"},
                                            {"-2", 0.18, "-7", "-7"},
                                            {"-1", 0.48, "0", "0"},
                                            {"0", 0.60, "2", "2"},
                                            {"1", 0.54, "0", "1"},
                                            {"2", 0.50, "0", "0"}}};
  const Tables tables = profiles({});
  for (const Column& column : kTable43) {
    const auto value = [&](const std::string& name) {
      return value_in(tables, "profiles", name,
                      {{"exponent", "halved"}, {"offset_cells", column.offset}});
    };
    EXPECT_NEAR(std::stod(value("ism")), column.ism, 0.01) << column.offset;
    EXPECT_EQ(value("blurring_index"), column.blurring) << column.offset;
    EXPECT_EQ(value("nearest_index"), column.nearest) << column.offset;
  }
}

// "up to k-3" and "from k+2".
TEST(Profiles, HaveUniformEnds) {
  const Tables tables = profiles({});
  for (const char* policy : {"blurring", "nearest"}) {
    const auto value = [&](const std::string& name) {
      return std::stoi(
          value_in(tables, "profile_ends", name, {{"exponent", "halved"}, {"policy", policy}}));
    };
    EXPECT_GE(value("same_until_cells"), -3);
    EXPECT_LT(value("same_until_cells"), value("same_from_cells"));
    EXPECT_LE(value("same_from_cells"), 2);
  }
}

// Only with the factor 1/2 does table 4.3 come out.
TEST(Profiles, DepartFromTheExponentOfEquation41) {
  EXPECT_NE(value_in(profiles({}), "profiles", "blurring_index",
                     {{"exponent", "as_printed"}, {"offset_cells", "-2"}}),
            "-7");
}

// "Close to 1" with cells of 5 sigma. With those of sigma / 4 Theorem 6 puts every cell from k on
// above 1/2, where the thesis sees the maximum below; it marks nothing all the same.
TEST(Profiles, HaveThePeaksOfFigure46) {
  const Tables tables = profiles({});
  const auto value = [&](const std::string& length, const std::string& name) {
    return std::stod(value_in(tables, "cell_length_peaks", name,
                              {{"exponent", "halved"}, {"cell_length_m", length}}));
  };
  EXPECT_GT(value("0.5", "largest_ism"), 0.99);
  EXPECT_NEAR(value("0.1", "largest_ism"), 0.6, 0.01);
  EXPECT_GT(value("0.025", "largest_ism"), 0.5);
  EXPECT_EQ(value("0.025", "blurring_index"), 0);
}

// Thesis section 3.4.6.3: 256 entries, so M = 127 and not more.
TEST(RecursiveSets, NeedTheTableThatTheThesisSays) {
  EXPECT_EQ(value_in(recursive_sets({}), "recursive_set_ranges", "largest_index",
                     {{"epsilon", "0.05"}, {"tail", "1e-11"}}),
            "127");
}

}  // namespace
}  // namespace iog::lab
