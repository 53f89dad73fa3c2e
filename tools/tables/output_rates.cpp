// Tables 4.4 and 4.5 of the thesis: grids a second on one Cortex-A9, and what that is worth.
#include <array>
#include <string>
#include <vector>

#include "tools/tables/cortex_a9.hpp"
#include "tools/tables/sections.hpp"

namespace iog::tools {
namespace {

constexpr double kClockHz = 1e9;
// Instructions per cycle: what is assumed, as in docs/figures.md.
constexpr double kQuick = 1.0;
constexpr double kSlow = 0.5;

// Table 4.4.
struct PaperRate {
  int sensors;
  double hz;
};
constexpr std::array<PaperRate, 3> kTable44{{{2, 66}, {3, 47}, {4, 28}}};
constexpr double kScannersHz = 25;

// Table 4.5, the row of the thesis itself: 16 layers of up to 200 points (section 4.1.4).
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

// Table 4.2: the time of the fan by the discrete traversal.
constexpr double kPaperFanSeconds = 0.007;

// Instructions and counts of one frame, the mean of the drive's unless said otherwise.
struct Frame {
  int sensors = 0;
  double paper_hz = 0;
  double points = 0;
  double points_used = 0;
  double cells = 0;
  double fused = 0;  // fuse + mark + clear
  double whole = 0;
  double largest = 0;  // the whole of the dearest frame
};

Frame frame_of(const PaperRate& paper) {
  const std::string run = "frame_cost sensors=" + std::to_string(paper.sensors);
  const auto value = [&](const char* key) { return measured_on_a9(run, key); };
  const double frames = value("frames");
  return {.sensors = paper.sensors,
          .paper_hz = paper.hz,
          .points = value("points") / frames,
          .points_used = value("points_used") / frames,
          .cells = value("cells") / frames,
          .fused = (value("fuse_sum") + value("mark_sum") + value("clear_sum")) / frames,
          .whole = value("frame_sum") / frames,
          .largest = value("frame_max")};
}

std::vector<Frame> frames_of_table_4_4() {
  return {frame_of(kTable44[0]), frame_of(kTable44[1]), frame_of(kTable44[2])};
}

double hz(double instructions, double per_cycle) { return kClockHz * per_cycle / instructions; }

// points cells Hz, in the thesis's unit. Our grid has as many cells as the thesis's.
double metric(double points, double frames_hz) { return points * kPaperCells * frames_hz / kUnit; }

// "76 to 151": what the assumptions leave open.
std::string range(double low, double high, int decimals) {
  return fixed(low, decimals) + " to " + fixed(high, decimals);
}

Verdict verdict(double paper, double low, double high) {
  return low > paper ? Verdict::kBeats : high < paper ? Verdict::kFallsShort : Verdict::kEquals;
}

Claim claim_on_rate(const Frame& frame) {
  const double low = hz(frame.whole, kSlow);
  const double high = hz(frame.whole, kQuick);
  return {.place = "table 4.4",
          .what = "grids a second with " + std::to_string(frame.sensors) + " LUX",
          .paper = fixed(frame.paper_hz, 0) + " Hz",
          .ours = range(low, high, 0) + " Hz, modelled",
          .verdict = verdict(frame.paper_hz, low, high),
          .reason = "instructions at 0.5 to 1 a cycle; the thesis's load is not known"};
}

Claim claim_on_real_time(const Frame& frame) {
  const double slowest = hz(frame.largest, kSlow);
  return {.place = "table 4.4",
          .what = "four LUX in real time, 25 Hz",
          .paper = "28 Hz on average",
          .ours = fixed(slowest, 0) + " Hz in the largest frame, modelled",
          .verdict = slowest > kScannersHz ? Verdict::kEquals : Verdict::kFallsShort,
          .reason = slowest > kScannersHz ? "" : "at 0.5 instructions a cycle"};
}

std::vector<Claim> claims_on_metric(const Frame& frame) {
  const double low = metric(frame.points, hz(frame.whole, kSlow));
  const double high = metric(frame.points, hz(frame.whole, kQuick));
  const std::string reason = "as table 4.4; the unit is taken from the thesis's own row";
  return {{.place = "table 4.5",
           .what = "points cells Hz, a GPU being 1",
           .paper = fixed(kPaperMetric, 0),
           .ours = range(low, high, 1) + ", modelled",
           .verdict = verdict(kPaperMetric, low, high),
           .reason = reason},
          {.place = "table 4.5",
           .what = "the same per watt, a GPU being 1",
           .paper = grouped(kPaperMetricPerWatt),
           .ours = grouped(low * kHommWatts) + " to " + grouped(high * kHommWatts) +
                   " at the thesis's 1 W, modelled",
           .verdict = verdict(kPaperMetricPerWatt, low * kHommWatts, high * kHommWatts),
           .reason = reason + "; no power was measured"}};
}

void print_instructions(const std::vector<Frame>& frames, Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(frames.size());
  for (const Frame& frame : frames) {
    rows.push_back({std::to_string(frame.sensors), grouped(frame.points),
                    grouped(frame.points_used), grouped(frame.cells), grouped(frame.fused),
                    grouped(frame.whole), grouped(frame.largest)});
  }
  body.table({"LUX", "scan points", "carve and mark", "cells carved", "fuse + mark + clear",
              "whole frame", "largest frame"},
             rows);
}

void print_rates(const std::vector<Frame>& frames, Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const Frame& frame : frames) {
    std::vector<std::string> row{std::to_string(frame.sensors), fixed(frame.paper_hz, 0)};
    for (const double instructions : {frame.fused, frame.whole, frame.largest}) {
      row.push_back(fixed(hz(instructions, kQuick), 0));
      row.push_back(fixed(hz(instructions, kSlow), 0));
    }
    rows.push_back(row);
  }
  body.table({"LUX", "paper, Hz", "fuse + mark + clear, at 1.0", "at 0.5", "whole frame, at 1.0",
              "at 0.5", "largest frame, at 1.0", "at 0.5"},
             rows);
}

Plot plot_of(const std::vector<Frame>& frames) {
  using Style = Series::Style;
  Series paper{.name = "thesis", .points = {}, .style = Style::kBars};
  Series quick{
      .name = "whole frame, 1.0 instructions a cycle", .points = {}, .style = Style::kBars};
  Series slow{.name = "whole frame, 0.5 instructions a cycle", .points = {}, .style = Style::kBars};
  Series scanners{.name = "the scanners", .points = {}, .style = Style::kLine};
  Plot plot{.title = "Grids a second on one Cortex-A9 at 1 GHz (table 4.4)",
            .x_label = "ibeo LUX",
            .y_label = "Hz",
            .series = {}};
  for (const Frame& frame : frames) {
    paper.points.emplace_back(frame.sensors, frame.paper_hz);
    quick.points.emplace_back(frame.sensors, hz(frame.whole, kQuick));
    slow.points.emplace_back(frame.sensors, hz(frame.whole, kSlow));
    scanners.points.emplace_back(frame.sensors, kScannersHz);
    plot.x_names.emplace_back(frame.sensors, std::to_string(frame.sensors));
  }
  plot.series = {paper, slow, quick, scanners};
  return plot;
}

// What the thesis's load may have been, judged by its own table 4.2, and ours at the most that four
// LUX can send.
void describe_loads(const Frame& frame, Markdown& body) {
  const std::string fan = "traversal_cost walk=discrete r=1024";
  const double fan_cells = measured_on_a9(fan, "cells");
  const double cells_a_beam = fan_cells / measured_on_a9(fan, "beams");
  const double instructions_a_cell = measured_on_a9(fan, "instructions") / fan_cells;
  const double paper_s_a_cell = kPaperFanSeconds / fan_cells;
  const double most_cells = kPaperPoints * cells_a_beam;
  const double most_instructions = most_cells * instructions_a_cell;
  body.paragraph(
      "The loads are not the same, and the thesis's is not known: it gives neither points nor "
      "cells a frame. Its own table 4.2 allows a guess. There 7 ms go into a fan that crosses " +
      grouped(fan_cells) + " cells (counted here), " + fixed(paper_s_a_cell * 1e9, 0) +
      " ns a cell; in the " + fixed(1000 / kPaperHz, 1) + " ms of a frame at 28 Hz that makes " +
      grouped(1 / kPaperHz / paper_s_a_cell) + " cells. Ours carves " + grouped(frame.cells) +
      ", so both are of one order. The most that four LUX could ask for is " +
      grouped(kPaperPoints) + " points, each walked to the end of its 50 m: " +
      grouped(most_cells) + " cells, which would be " +
      fixed(most_cells * paper_s_a_cell * 1e3, 0) + " ms at the thesis's time for a cell and " +
      fixed(most_instructions / kClockHz / kQuick * 1e3, 0) + " to " +
      fixed(most_instructions / kClockHz / kSlow * 1e3, 0) +
      " ms at ours. A walk here ends at its hit, as the indexes behind it are 0; whether the "
      "thesis's goes on to the end of its local grid it does not say.");
}

void describe_rates(const TablesInput& input, const std::vector<Frame>& frames, Markdown& body) {
  body.paragraph(
      "Instructions a frame, measured: every instruction that the emulated Cortex-A9 executes "
      "(`bench/cortex_a9.txt`, written by `bench/measure_a9`), " +
      grouped(measured_on_a9("frame_cost sensors=4", "frames")) +
      " frames of the simulated drive of seed 1, two, three or all four LUX of the reference "
      "car. *Whole frame* is receiving, fusing, marking and publishing: finding, hashing, "
      "wrapping and clearing the known tiles.");
  print_instructions(frames, body);
  body.paragraph(
      "Grids a second at 1 GHz, **modelled**: those counts by an assumed number of instructions a "
      "cycle, 1.0 or 0.5, as in [figures.md](figures.md). QEMU has no caches and no pipeline, and "
      "a model of the A9's cycles is not done yet.");
  print_rates(frames, body);
  body.picture(draw(input, "output_rates.svg", plot_of(frames)),
               "Grids a second by the number of LUX");
  body.paragraph(
      "What the thesis timed is the fusion of the scan points into a grid that starts from 0; it "
      "does not say whether setting the grid to 0 or sending it is in its rates. Fuse + mark + "
      "clear is what compares with it at all events, the whole frame is what a receiver waits "
      "for. Decoding and checking the sensors' messages are in both.");
  describe_loads(frames.back(), body);
  body.paragraph("By table 4.4 a LUX takes the thesis " + fixed(1000 / 66.0 / 2, 1) +
                 " ms in the first two, " + fixed(1000 / 47.0 - 1000 / 66.0, 1) +
                 " ms as the third and " + fixed(1000 / 28.0 - 1000 / 47.0, 1) +
                 " ms as the fourth, for which it gives no reason. Here the third adds " +
                 percent(frames[1].whole / frames[0].whole - 1, 0) + " and the fourth " +
                 percent(frames[2].whole / frames[1].whole - 1, 0) + ".");
}

void print_metric(const Frame& frame, Markdown& body) {
  const double low = metric(frame.points, hz(frame.whole, kSlow));
  const double high = metric(frame.points, hz(frame.whole, kQuick));
  body.table({"", "Homm 2010", "Nuss 2015", "thesis", "ours at 1.0", "ours at 0.5"},
             {{"hardware", "GeForce 268GTX", "desktop", "one ARM A9", "one ARM A9", "one ARM A9"},
              {"power", "204 W", "about 80 W", "1 W", "1 W, by the thesis", "1 W, by the thesis"},
              {"layers", "2", "4", "16", "16", "16"},
              {"cells", "512 x 512", "533 x 533", "1000 x 1000", "as the thesis", "as the thesis"},
              {"points a frame", "not in the text", "not in the text", grouped(kPaperPoints),
               grouped(frame.points), grouped(frame.points)},
              {"frames a second", "not in the text", "not in the text", fixed(kPaperHz, 0),
               fixed(hz(frame.whole, kQuick), 1), fixed(hz(frame.whole, kSlow), 1)},
              {"points cells Hz", "1", fixed(kNussMetric, 1), fixed(kPaperMetric, 0),
               fixed(high, 1), fixed(low, 1)},
              {"points cells Hz / W", "1", "about 1", grouped(kPaperMetricPerWatt),
               grouped(high * kHommWatts), grouped(low * kHommWatts)}});
}

void describe_metric(const Frame& frame, Markdown& body) {
  body.subheading("Points cells Hz: table 4.5");
  body.paragraph(
      "The formula: scan points a frame, times cells of the grid, times frames a second, divided "
      "by the same product of Homm 2010. The thesis gives that product for nobody, so the unit is "
      "worked out from its own row: " +
      grouped(kPaperPoints) + " points (16 layers of 200, the most that section 4.1.4 allows) x " +
      grouped(kPaperCells) + " cells x 28 Hz / 5 = " + scientific(kUnit, 3) +
      ". Per watt it is divided by the power and multiplied by Homm's 204 W; the thesis's 1,030 "
      "says that its 5 was " +
      fixed(kPaperMetricPerWatt / kHommWatts, 2) + " before it was rounded.");
  print_metric(frame, body);
  body.paragraph(
      "Ours is the whole mean frame of four LUX; fuse + mark + clear alone is " +
      range(metric(frame.points, hz(frame.fused, kSlow)),
            metric(frame.points, hz(frame.fused, kQuick)), 1) +
      ". The grid has 1024 x 1024 cells in the thesis's text and here, and is counted as 1000 x "
      "1000 for both. The thesis's points are the most that its scanners can send and ours are "
      "those that came; with fewer than " +
      grouped(kPaperPoints) +
      " the thesis's unit would be smaller and our number greater. The power is the thesis's "
      "figure for the same processor, not a measurement.");
  body.paragraph(
      "The rows of the GPU and of the desktop cannot be repeated: their points and rates are not "
      "in the text. By the unit Homm 2010 would have fused " +
      grouped(kUnit / kHommCells) + " points a second and Nuss 2015 " +
      grouped(kNussMetric * kUnit / kNussCells) +
      "; whether they did, the text does not say. Nor is the metric fair to them: it counts cells "
      "that nobody visits, so that a larger empty grid is a better one. Cells carved a second are "
      "not so easily had: " +
      range(frame.cells * hz(frame.whole, kSlow) / 1e6, frame.cells * hz(frame.whole, kQuick) / 1e6,
            0) +
      " million here, modelled.");
}

}  // namespace

Section output_rates(const TablesInput& input) {
  const std::vector<Frame> frames = frames_of_table_4_4();
  Section section;
  for (const Frame& frame : frames) {
    section.claims.push_back(claim_on_rate(frame));
  }
  section.claims.push_back(claim_on_real_time(frames.back()));
  for (const Claim& claim : claims_on_metric(frames.back())) {
    section.claims.push_back(claim);
  }
  section.body.heading("Output rates: tables 4.4 and 4.5");
  describe_rates(input, frames, section.body);
  describe_metric(frames.back(), section.body);
  return section;
}

}  // namespace iog::tools
