// Figure 3.6 of the thesis, and what its section 3.4.6.3 says of the range that an index needs.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "index/recursive_set.hpp"
#include "tools/reference/fusion.hpp"
#include "tools/tables/sections.hpp"

namespace iog::tools {
namespace {

constexpr std::array kFigureEpsilons{0.05, 0.01, 0.005};
constexpr std::array kTableEpsilons{0.1, 0.05, 0.01, 0.005, 1e-3, 1e-4, 1e-5, 1e-6};
constexpr std::array kTails{1e-3, 1e-6, 1e-11};
constexpr int kFigureIndexes = 25;  // figure 3.6 shows -25 ... 25
constexpr int kByteIndexes = 127;

// l(p_1): the log-odds of p_n are n times those of p_1 = 1/2 + epsilon.
double log_odds_step(double epsilon) { return 2 * std::atanh(2 * epsilon); }

// 1 - p_n without its cancellation: a double near 1 has only 16 digits behind the point to tell
// 1 - p_127 = 8.55e-12 from 0, its log-odds have them all.
double complement(double epsilon, int n) { return 1 / (1 + std::exp(n * log_odds_step(epsilon))); }

// The smallest M with p_-M <= tail, and so p_M >= 1 - tail.
double indexes_to_tail(double epsilon, double tail) {
  return std::ceil((std::log1p(-tail) - std::log(tail)) / log_odds_step(epsilon));
}

int bytes_of_index(double largest) {
  if (largest <= std::numeric_limits<std::int8_t>::max()) {
    return 1;
  }
  return largest <= std::numeric_limits<std::int16_t>::max() ? 2 : 4;
}

// How many elements lie in [0.05, 0.95].
int elements_between(const index::RecursiveSet& set) {
  int n = 0;
  while (set.probability(n + 1) <= 0.95) {
    ++n;
  }
  return 2 * n + 1;
}

std::string range_of_figure(double epsilon, int decimals) {
  const index::RecursiveSet set(epsilon);
  return fixed(set.probability(-kFigureIndexes), decimals) + " ... " +
         fixed(set.probability(kFigureIndexes), decimals);
}

Plot figure_3_6() {
  Plot plot{
      .title = "Recursive sets (figure 3.6)", .x_label = "index n", .y_label = "p_n", .series = {}};
  for (const double epsilon : kFigureEpsilons) {
    const index::RecursiveSet set(epsilon);
    Series series{.name = "epsilon = " + fixed(epsilon, epsilon < 0.01 ? 3 : 2),
                  .points = {},
                  .style = Series::Style::kPoints};
    for (int n = -kFigureIndexes; n <= kFigureIndexes; ++n) {
      series.points.emplace_back(n, set.probability(n));
    }
    plot.series.push_back(series);
  }
  return plot;
}

// The largest |a_n - p_n|, |b_n - p_-n| up to 127, a_n and b_n by the recursion of theorem 3.
double difference_to_recursion(double epsilon) {
  const index::RecursiveSet set(epsilon);
  double a = 0.5;
  double b = 0.5;
  double largest = 0;
  for (int n = 1; n <= kByteIndexes; ++n) {
    a = reference::fuse_bayes(a, 0.5 + epsilon);
    b = reference::fuse_bayes(b, 0.5 - epsilon);
    largest = std::fmax(largest, std::fabs(a - set.probability(n)));
    largest = std::fmax(largest, std::fabs(b - set.probability(-n)));
  }
  return largest;
}

void describe_sets(Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const double epsilon : kFigureEpsilons) {
    const index::RecursiveSet set(epsilon);
    rows.push_back({fixed(epsilon, 3), range_of_figure(epsilon, 4),
                    scientific(set.probability(-kByteIndexes), 2),
                    scientific(complement(epsilon, kByteIndexes), 2),
                    std::to_string(elements_between(set)),
                    scientific(difference_to_recursion(epsilon), 0)});
  }
  body.table({"epsilon", "p_-25 ... p_25", "p_-127", "1 - p_127", "elements in [0.05, 0.95]",
              "largest difference to theorem 3"},
             rows);
  body.paragraph(
      "p_n is what the firmware's code computes (`src/index/recursive_set.hpp`), 1 - p_127 "
      "comes from the log-odds, because the subtraction would leave five digits of it. The "
      "last column compares with the recursion that theorem 3 defines the set by, p_n = "
      "p_(n-1) fused with p_1 by equation 3.2, for all |n| <= 127: rounding, nothing else.");
}

void describe_ranges(Markdown& body) {
  body.subheading("How long a lookup table must be");
  body.paragraph(
      "A table from indexes to probabilities holds -M ... M, that is 2 M + 1 entries. M is the "
      "smallest index with p_-M at or below the tail. The bytes are those of a cell that holds "
      "-M ... M. The last column is what one beam says of a cell that it passes: the floor of "
      "0.05, blurred.");
  std::vector<std::vector<std::string>> rows;
  for (const double epsilon : kTableEpsilons) {
    std::vector<std::string> row{scientific(epsilon, 0)};
    for (const double tail : kTails) {
      const double m = indexes_to_tail(epsilon, tail);
      row.push_back(grouped(2 * m + 1));
      row.push_back(std::to_string(bytes_of_index(m)));
    }
    row.push_back(
        grouped(index::RecursiveSet(epsilon).quantise(0.05, index::Quantisation::kBlurring)));
    rows.push_back(row);
  }
  body.table({"epsilon", "entries, tail 1e-3", "bytes", "entries, tail 1e-6", "bytes",
              "entries, tail 1e-11", "bytes", "free index"},
             rows);
}

std::vector<Claim> claims_of_figure() {
  std::vector<Claim> claims;
  for (const double epsilon : {0.01, 0.005}) {
    const index::RecursiveSet set(epsilon);
    const bool is_inside =
        set.probability(-kFigureIndexes) > 0.2 && set.probability(kFigureIndexes) < 0.8;
    claims.push_back({.place = "figure 3.6",
                      .what = "p_-25 ... p_25 at epsilon = " + fixed(epsilon, 3),
                      .paper = "inside ]0.2, 0.8[",
                      .ours = range_of_figure(epsilon, 3),
                      .verdict = is_inside ? Verdict::kEquals : Verdict::kFallsShort,
                      .reason = is_inside ? "" : "p_n by the formula of theorem 3"});
  }
  return claims;
}

std::vector<Claim> claims_of_range() {
  const double below = index::RecursiveSet(0.05).probability(-kByteIndexes);
  const double above = complement(0.05, kByteIndexes);
  const double entries = 2 * indexes_to_tail(0.05, 1e-11) + 1;
  const auto claim = [](const char* what, const char* paper, const std::string& ours, bool holds) {
    return Claim{.place = "section 3.4.6.3",
                 .what = what,
                 .paper = paper,
                 .ours = ours,
                 .verdict = holds ? Verdict::kEquals : Verdict::kFallsShort,
                 .reason = holds ? "" : "p_n by the formula of theorem 3"};
  };
  return {claim("p_-127 at epsilon = 0.05", "below 1e-11", scientific(below, 2), below < 1e-11),
          claim("1 - p_127 at epsilon = 0.05", "below 1e-11", scientific(above, 2), above < 1e-11),
          claim("lookup table to a tail of 1e-11 at epsilon = 0.05", "256 entries are enough",
                grouped(entries) + " are needed", entries <= 256)};
}

}  // namespace

Section recursive_sets(const TablesInput& input) {
  Section section;
  section.claims = claims_of_figure();
  for (const Claim& claim : claims_of_range()) {
    section.claims.push_back(claim);
  }
  Markdown& body = section.body;
  body.heading("Recursive sets: figure 3.6");
  body.paragraph(
      "p_n = 1 / (1 + ((1/2 - epsilon) / (1/2 + epsilon))^n). A small epsilon puts many "
      "elements around 1/2 and few near 0 and 1: with |n| <= 25 the thesis finds the sets of "
      "0.01 and 0.005 inside ]0.2, 0.8[ and that of 0.05 spread over ]0, 1[.");
  body.picture(draw(input, "recursive_sets.svg", figure_3_6()),
               "p_n over n for epsilon = 0.05, 0.01 and 0.005");
  describe_sets(body);
  describe_ranges(body);
  body.paragraph(
      "So the thesis's choice is the smallest table that keeps its promise: at epsilon = 0.05, "
      "p_-126 is still " +
      scientific(index::RecursiveSet(0.05).probability(1 - kByteIndexes), 3) +
      ". An int8 is enough for the index of one beam down to epsilon = 0.01, but it can then "
      "say no less than p_-127 = " +
      scientific(index::RecursiveSet(0.01).probability(-kByteIndexes), 1) +
      ". Each step of ten in epsilon costs ten times the indexes: l(p_1) is close to 4 epsilon.");
  return section;
}

}  // namespace iog::tools
