#include "lab/experiments/points_cells_hz.hpp"

#include <string>

namespace iog::lab {
namespace {

// The row of the thesis itself: 16 layers of up to 200 points (section 4.1.4).
constexpr double kPaperPoints = 16 * 200;
constexpr double kPaperCells = 1000.0 * 1000.0;
constexpr double kPaperHz = 28;
constexpr double kPaperMetric = 5;
constexpr double kPaperMetricPerWatt = 1030;
constexpr double kHommWatts = 204;
constexpr double kHommCells = 512.0 * 512.0;
constexpr double kNussMetric = 0.4;
constexpr double kNussCells = 533.0 * 533.0;
// What the unit of the metric must be for its row to come out.
constexpr double kUnit = kPaperPoints * kPaperCells * kPaperHz / kPaperMetric;

// points cells Hz, in the thesis's unit. Our grid has as many cells as the thesis's.
double metric(double points, double frames_hz) { return points * kPaperCells * frames_hz / kUnit; }

Modelled metric(double points, const Modelled& frames_hz) { return frames_hz * metric(points, 1); }

// A frame of ours: what was counted, and how often a second it comes.
struct Ours {
  A9Frame frame;
  Modelled fused_hz;
  Modelled whole_hz;

  [[nodiscard]] Modelled whole_metric() const { return metric(frame.points, whole_hz); }
};

void add_claims(const Ours& ours, Section& section) {
  const Modelled whole = ours.whole_metric();
  const Modelled per_watt = whole * kHommWatts;
  const std::string reason = "as table 4.4, with " + grouped(ours.frame.points) +
                             " points a frame; the unit counts " + grouped(kPaperPoints) +
                             " for the thesis, the most that four LUX send";
  section.claims.push_back({.place = "table 4.5",
                            .what = "points cells Hz, a GPU being 1",
                            .paper = fixed(kPaperMetric, 0),
                            .ours = banded(whole, 1) + ", modelled",
                            .verdict = verdict_by_nominal(kPaperMetric, whole),
                            .reason = reason});
  section.claims.push_back({.place = "table 4.5",
                            .what = "the same per watt, a GPU being 1",
                            .paper = grouped(kPaperMetricPerWatt),
                            .ours = banded(per_watt, 0) + " at the thesis's 1 W, modelled",
                            .verdict = verdict_by_nominal(kPaperMetricPerWatt, per_watt),
                            .reason = reason + "; no power was measured"});
}

void print_metric(const Ours& ours, Markdown& body) {
  const Modelled whole = ours.whole_metric();
  body.table(
      {"", "Homm 2010", "Nuss 2015", "thesis", "ours"},
      {{"hardware", "GeForce 268GTX", "desktop", "one ARM A9", "one ARM A9"},
       {"power", "204 W", "about 80 W", "1 W", "1 W, by the thesis"},
       {"layers", "2", "4", "16", "16"},
       {"cells", "512 x 512", "533 x 533", "1000 x 1000", "as the thesis"},
       {"points a frame", "not in the text", "not in the text", grouped(kPaperPoints),
        grouped(ours.frame.points)},
       {"frames a second", "not in the text", "not in the text", fixed(kPaperHz, 0),
        banded(ours.whole_hz, 1)},
       {"points cells Hz", "1", fixed(kNussMetric, 1), fixed(kPaperMetric, 0), banded(whole, 1)},
       {"points cells Hz / W", "1", "about 1", grouped(kPaperMetricPerWatt),
        banded(whole * kHommWatts, 0)}});
}

void describe_formula(Markdown& body) {
  body.paragraph(
      "The formula: scan points a frame, times cells of the grid, times frames a second, divided "
      "by the same product of Homm 2010. The thesis gives that product for nobody, so the unit is "
      "worked out from its own row: " +
      grouped(kPaperPoints) + " points (16 layers of 200, the most that section 4.1.4 allows) x " +
      grouped(kPaperCells) + " cells x " + fixed(kPaperHz, 0) + " Hz / " + fixed(kPaperMetric, 0) +
      " = " + scientific(kUnit, 3) +
      ". Per watt it is divided by the power and multiplied by Homm's 204 W; the thesis's " +
      grouped(kPaperMetricPerWatt) + " says that its 5 was " +
      fixed(kPaperMetricPerWatt / kHommWatts, 2) + " before it was rounded.");
}

void describe_rows(const Ours& ours, Markdown& body) {
  body.paragraph(
      "Ours is the whole mean frame of four LUX on the ring road, modelled; fuse + mark + clear "
      "alone is " +
      banded(metric(ours.frame.points, ours.fused_hz), 1) +
      ". The thesis's points are the most that its scanners can send, ours are those that came: "
      "many beams of a wide road meet nothing, walk nowhere and are not counted. Had the thesis's "
      "frames as many points as ours, its row would stay " +
      fixed(kPaperMetric, 0) + " and ours would be " +
      banded(ours.whole_hz * (kPaperMetric / kPaperHz), 1) +
      ". The grid has 1024 x 1024 cells in the thesis's text and here, and is counted as 1000 x "
      "1000 for both. The power is the thesis's figure for the same processor, not a measurement.");
  body.paragraph(
      "The rows of the GPU and of the desktop cannot be repeated: their points and rates are not "
      "in the text. By the unit Homm 2010 would have fused " +
      grouped(kUnit / kHommCells) + " points a second and Nuss 2015 " +
      grouped(kNussMetric * kUnit / kNussCells) +
      "; whether they did, the text does not say. Nor is the metric fair to them: it counts cells "
      "that nobody visits, so that a larger empty grid is a better one. Cells carved a second are "
      "not so easily had: " +
      banded(ours.whole_hz * (ours.frame.cells / 1e6), 0) + " million here, modelled.");
}

}  // namespace

void add_points_cells_hz(const A9Frame& frame, const A9Cycles& cycles, Section& section) {
  const Ours ours{.frame = frame,
                  .fused_hz = hz_of(cycles_of(frame.fused, cycles.fused)),
                  .whole_hz = hz_of(cycles_of(frame.whole, cycles.whole))};
  add_claims(ours, section);
  section.body.subheading("Points cells Hz: table 4.5");
  describe_formula(section.body);
  print_metric(ours, section.body);
  describe_rows(ours, section.body);
}

}  // namespace iog::lab
