// Table 4.3 and figure 4.14 of the thesis: what a scan point says of the cells around it.
#include <algorithm>
#include <array>
#include <cmath>

#include "index/recursive_set.hpp"
#include "lab/experiments/cell_length.hpp"
#include "lab/experiments/sections.hpp"
#include "sensor_model/profile.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;
using sensor_model::make_profile;
using sensor_model::Profile;

constexpr double kSigmaM = 0.10;
constexpr double kEpsilon = 0.05;
constexpr double kFloor = 0.05;

constexpr Profile kBlurring = make_profile({});
constexpr Profile kNearest = make_profile({.quantisation = Quantisation::kNearest});

// Equation 4.1 lacks the 1/2 in its exponent: a Gaussian of sigma / sqrt(2).
constexpr double kPrintedSigmaM = kSigmaM / 1.41421356237309504880;
constexpr Profile kPrintedBlurring = make_profile({.sigma_m = kPrintedSigmaM});
constexpr Profile kPrintedNearest =
    make_profile({.sigma_m = kPrintedSigmaM, .quantisation = Quantisation::kNearest});

// A column of table 4.3, as the thesis prints it.
struct PaperColumn {
  const char* cell;
  int offset;  // of the cell nearest to k, where the column stands for many
  double ism;
  int blurring;
  int nearest;
};
constexpr std::array<PaperColumn, 6> kTable43{{{"up to k-3", -3, 0.05, -14, -15},
                                               {"k-2", -2, 0.18, -7, -7},
                                               {"k-1", -1, 0.48, 0, 0},
                                               {"k", 0, 0.60, 2, 2},
                                               {"k+1", 1, 0.54, 0, 1},
                                               {"from k+2", 2, 0.50, 0, 0}}};

// What the firmware's code makes of the sensor model before it is quantised.
double ism(double sigma_m, int offset) {
  const sensor_model::SingleTarget model{.sigma_m = sigma_m, .cell_length_m = 0.10};
  return std::max(model.probability(offset), kFloor);
}

// Those of table 4.3 in one line, to compare and to print: "-14, -7, 0, 2, 0, 0".
std::string indexes_of(const Profile& profile) {
  std::string text;
  for (const PaperColumn& column : kTable43) {
    text += (text.empty() ? "" : ", ") + std::to_string(profile.at(column.offset));
  }
  return text;
}

std::string indexes_of_paper(int PaperColumn::*policy) {
  std::string text;
  for (const PaperColumn& column : kTable43) {
    text += (text.empty() ? "" : ", ") + std::to_string(column.*policy);
  }
  return text;
}

// That the cells beyond the near ones have the outer columns' indexes, as far as the beam reaches.
bool has_uniform_ends(const Profile& profile) {
  for (int distance = 3; distance <= 500; ++distance) {
    if (profile.at(-distance) != profile.at(-3) || profile.at(distance - 1) != profile.at(2)) {
      return false;
    }
  }
  return true;
}

void print_table_4_3(Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const PaperColumn& column : kTable43) {
    const int offset = column.offset;
    rows.push_back({column.cell, fixed(column.ism, 2), fixed(ism(kSigmaM, offset), 4),
                    std::to_string(column.blurring), std::to_string(kBlurring.at(offset)),
                    std::to_string(column.nearest), std::to_string(kNearest.at(offset)),
                    fixed(ism(kPrintedSigmaM, offset), 4),
                    std::to_string(kPrintedBlurring.at(offset)),
                    std::to_string(kPrintedNearest.at(offset))});
  }
  body.table({"cell", "ISM, paper", "ours", "blurring, paper", "ours", "nearest, paper", "ours",
              "ISM by 4.1 as printed", "blurring", "nearest"},
             rows);
}

Plot figure_4_14() {
  Plot plot{.title = "ISM of the local grid and its quantisations (figure 4.14)",
            .x_label = "cell",
            .y_label = "probability",
            .series = {}};
  Series model{.name = "ISM, not below 0.05", .points = {}, .style = Series::Style::kLine};
  Series blurring{.name = "blurring", .points = {}, .style = Series::Style::kPoints};
  Series nearest{.name = "nearest", .points = {}, .style = Series::Style::kPoints};
  const index::RecursiveSet set(kEpsilon);
  for (int offset = -6; offset <= 5; ++offset) {
    model.points.emplace_back(offset, ism(kSigmaM, offset));
    blurring.points.emplace_back(offset, set.probability(kBlurring.at(offset)));
    nearest.points.emplace_back(offset, set.probability(kNearest.at(offset)));
    const std::string sign = offset > 0 ? "+" : "";
    plot.x_names.emplace_back(offset, offset == 0 ? "k" : "k" + sign + std::to_string(offset));
  }
  plot.series = {model, blurring, nearest};
  return plot;
}

Claim claim_on_indexes(const std::string& policy, const Profile& profile,
                       int PaperColumn::*column) {
  const bool is_equal =
      indexes_of(profile) == indexes_of_paper(column) && has_uniform_ends(profile);
  return {.place = "table 4.3",
          .what = "indexes, " + policy,
          .paper = indexes_of_paper(column),
          .ours = indexes_of(profile),
          .verdict = is_equal ? Verdict::kEquals : Verdict::kFallsShort,
          .reason = is_equal ? "" : "see the section"};
}

// The thesis prints two digits, the last of them cut off or rounded.
Claim claim_on_probabilities() {
  double largest = 0;
  for (const PaperColumn& column : kTable43) {
    largest = std::max(largest, std::fabs(ism(kSigmaM, column.offset) - column.ism));
  }
  return {.place = "table 4.3",
          .what = "ISM of the six columns",
          .paper = "two digits",
          .ours = "within " + fixed(largest, 3),
          .verdict = largest < 0.01 ? Verdict::kEquals : Verdict::kFallsShort,
          .reason = largest < 0.01 ? "" : "see the section"};
}

Claim claim_on_exponent() {
  const bool is_needed = indexes_of(kPrintedBlurring) != indexes_of_paper(&PaperColumn::blurring);
  return {.place = "equation 4.1",
          .what = "exponent of the sensor model",
          .paper = "-(z-d)^2 / sigma^2",
          .ours = "-(z-d)^2 / (2 sigma^2)",
          .verdict = is_needed ? Verdict::kDeparts : Verdict::kFallsShort,
          .reason = "as printed it gives " + indexes_of(kPrintedBlurring) +
                    " for table 4.3, with the usual 1/2 it gives the table"};
}

void describe_table(Markdown& body) {
  body.paragraph(
      "The profile of a LUX, sigma and cells of 0.10 m, epsilon = 0.05, an ISM below 0.05 "
      "raised to it. Ours is what the firmware's code has (`src/sensor_model/profile.hpp`), "
      "computed by the compiler.");
  print_table_4_3(body);
  body.paragraph(
      "Equation 4.1 prints the Gaussian without the factor 1/2 in its exponent, as if sigma were " +
      fixed(kPrintedSigmaM, 4) +
      " m. The last three columns show what Theorem 6 makes of that: neither the ISM nor the "
      "indexes of table 4.3. With the factor all come out, so it is the equation that lost it, "
      "not the thesis's program. (As printed it is no density either: its integral over z is " +
      fixed(std::sqrt(0.5), 3) + ".)");
}

}  // namespace

Section profiles(const TablesInput& input) {
  Section section;
  section.claims = {
      claim_on_probabilities(), claim_on_indexes("blurring", kBlurring, &PaperColumn::blurring),
      claim_on_indexes("nearest", kNearest, &PaperColumn::nearest), claim_on_exponent()};
  Markdown& body = section.body;
  body.heading("Profiles: table 4.3, figures 4.6 and 4.14");
  describe_table(body);
  body.picture(draw(input, "profile.svg", figure_4_14()),
               "The ISM around cell k and what both policies make of it");
  add_cell_lengths(input, section);
  return section;
}

}  // namespace iog::lab
