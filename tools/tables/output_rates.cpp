// Table 4.4 of the thesis: grids a second on one Cortex-A9, at the load that its table 4.7 implies;
// table 4.5, what that is worth, follows.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tools/tables/a9_frame.hpp"
#include "tools/tables/cortex_a9.hpp"
#include "tools/tables/points_cells_hz.hpp"
#include "tools/tables/scene_load.hpp"
#include "tools/tables/sections.hpp"

namespace iog::tools {
namespace {

// Table 4.4.
struct PaperRate {
  int sensors;
  double hz;
};
constexpr std::array<PaperRate, 3> kTable44{{{2, 66}, {3, 47}, {4, 28}}};
constexpr double kScannersHz = 25;

// Table 4.2: the time of the fan by the discrete traversal.
constexpr double kPaperFanSeconds = 0.007;

// Table 4.7, blurring.
constexpr double kCellsALeaf = 3.75;  // at epsilon = 0.1
constexpr const char* kCellsALeafRange = "3.74 to 3.78";
constexpr const char* kCellsANodeRange = "2.81 to 2.84";

// Section 4.1.4: 16 layers of up to 200 points.
constexpr double kMostPoints = 16 * 200;

// One row of table 4.4 beside ours.
struct Rate {
  double paper_hz = 0;
  A9Frame frame;
};

struct Scene {
  std::string words;
  SceneLoad load;
  std::vector<Rate> rates;  // as kTable44
};

Scene scene_of(const char* name, const char* words) {
  Scene scene{.words = words, .load = load_of(name, kA9Seed, kA9Seconds), .rates = {}};
  for (const PaperRate& paper : kTable44) {
    scene.rates.push_back({.paper_hz = paper.hz, .frame = a9_frame(name, paper.sensors)});
  }
  return scene;
}

// The load at which the thesis is compared with, and a lighter one beside it.
struct Scenes {
  Scene matched = scene_of("ring_road", "ring road");
  Scene city = scene_of("city", "city");
};

Claim claim_on_rate(const Rate& rate) {
  const A9Frame& frame = rate.frame;
  const double slow = modelled_hz(frame.whole, kSlow);
  return {.place = "table 4.4",
          .what = "grids a second with " + std::to_string(frame.sensors) + " LUX",
          .paper = fixed(rate.paper_hz, 0) + " Hz",
          .ours = range(slow, modelled_hz(frame.whole, kQuick), 1) + " Hz, modelled",
          .verdict = verdict_on(rate.paper_hz, slow),
          .reason =
              "on a ring road, taken for the thesis's load; decided at 0.5 instructions a "
              "cycle; without receiving and sending " +
              range(modelled_hz(frame.fused, kSlow), modelled_hz(frame.fused, kQuick), 1) + " Hz"};
}

Claim claim_on_real_time(const A9Frame& frame) {
  const double slowest = modelled_hz(frame.largest, kSlow);
  return {.place = "table 4.4",
          .what = "four LUX in real time, 25 Hz",
          .paper = "28 Hz on average",
          .ours = fixed(slowest, 1) + " Hz in the largest frame, modelled",
          .verdict = slowest > kScannersHz ? Verdict::kEquals : Verdict::kFallsShort,
          .reason = slowest > kScannersHz ? "" : "on a ring road, at 0.5 instructions a cycle"};
}

void print_loads(const Scenes& scenes, Markdown& body) {
  std::vector<std::vector<std::string>> rows{
      {"thesis, table 4.7, blurring", kCellsALeafRange, kCellsANodeRange, "not in the text"}};
  for (const Scene* scene : {&scenes.matched, &scenes.city}) {
    const SceneLoad& load = scene->load;
    rows.push_back({scene->words, fixed(load.cells_per_leaf, 2), fixed(load.cells_per_node, 2),
                    grouped(load.known_cells)});
  }
  body.table({"", "cells a leaf", "cells a node", "known cells a frame"}, rows);
}

// By the thesis's own time for a cell, how many a frame of its can have had.
void describe_other_trace(const Scenes& scenes, Markdown& body) {
  const std::string fan = "traversal_cost walk=discrete r=1024";
  const double fan_cells = measured_on_a9(fan, "cells");
  const double paper_s_a_cell = kPaperFanSeconds / fan_cells;
  const Rate& four = scenes.matched.rates.back();
  const double paper_cells = 1 / four.paper_hz / paper_s_a_cell;
  const double city_cells = scenes.city.rates.back().frame.cells;
  const double most_cells = kMostPoints * fan_cells / measured_on_a9(fan, "beams");
  body.paragraph(
      "The times of table 4.2 are a weaker trace. There 7 ms go into a fan that crosses " +
      grouped(fan_cells) + " cells (counted here), " + fixed(paper_s_a_cell * 1e9, 0) +
      " ns a cell; a frame at " + fixed(four.paper_hz, 0) + " Hz that were nothing else would be " +
      grouped(paper_cells) + " cells. Four LUX carve " + fixed(four.frame.cells / paper_cells, 2) +
      " times as many on the ring road (" + grouped(four.frame.cells) + ") and " +
      fixed(city_cells / paper_cells, 2) + " times as many in the city (" + grouped(city_cells) +
      "). The most that they could ask for is " + grouped(kMostPoints) +
      " points, each walked to the end of its 50 m: " + grouped(most_cells) + " cells, " +
      fixed(most_cells * paper_s_a_cell * 1e3, 0) +
      " ms at the thesis's time for a cell. A walk here ends at its hit, as the indexes behind it "
      "are 0; whether the thesis's goes on to the end of its local grid it does not say.");
}

void describe_loads(const Scenes& scenes, Markdown& body) {
  body.subheading("The load");
  body.paragraph(
      "What a frame costs depends on what the scanners see, and the thesis gives neither scan "
      "points nor cells of its frames. It leaves one trace of them in table 4.7: for how many "
      "cells a leaf of its quadtree stands. The cells of a beam differ from their neighbours and "
      "cannot share a leaf, so a leaf stands for the fewer cells the more of the grid is crossed "
      "by beams. The same count here, of all frames of two simulated drives (`" +
      std::string(a9_made_with("capture scene=ring_road")) +
      "`, and the same in the city), fused on the PC by rule bayes with blurring; the tree is only "
      "counted, not built:");
  print_loads(scenes, body);
  body.paragraph(
      "So the ring road is taken for the matched load, and what is compared with the thesis is "
      "compared there; the city, a street between houses, is beside it and flatters. The ring "
      "road's traffic and verge were chosen to make this count come out; it is " +
      percent(std::abs(scenes.matched.load.cells_per_leaf / kCellsALeaf - 1), 1) +
      " off the thesis's " + fixed(kCellsALeaf, 2) +
      ". That is a match of one number, not a proof that the thesis drove on such a road.");
  describe_other_trace(scenes, body);
}

void print_instructions(const Scenes& scenes, Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const Scene* scene : {&scenes.matched, &scenes.city}) {
    for (const Rate& rate : scene->rates) {
      const A9Frame& frame = rate.frame;
      rows.push_back({scene->words, std::to_string(frame.sensors), grouped(frame.points),
                      grouped(frame.points_used), grouped(frame.cells), grouped(frame.fused),
                      grouped(frame.whole), grouped(frame.largest)});
    }
  }
  body.table({"scene", "LUX", "scan points", "carve and mark", "cells carved",
              "fuse + mark + clear", "whole frame", "largest frame"},
             rows);
}

void print_rates(const Scenes& scenes, Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const Scene* scene : {&scenes.matched, &scenes.city}) {
    for (const Rate& rate : scene->rates) {
      const A9Frame& frame = rate.frame;
      std::vector<std::string> row{scene->words, std::to_string(frame.sensors),
                                   fixed(rate.paper_hz, 0)};
      for (const double instructions : {frame.fused, frame.whole, frame.largest}) {
        row.push_back(fixed(modelled_hz(instructions, kSlow), 1));
        row.push_back(fixed(modelled_hz(instructions, kQuick), 1));
      }
      rows.push_back(row);
    }
  }
  body.table({"scene", "LUX", "paper, Hz", "fuse + mark + clear, at 0.5", "at 1.0",
              "whole frame, at 0.5", "at 1.0", "largest frame, at 0.5", "at 1.0"},
             rows);
}

Plot plot_of(const Scenes& scenes) {
  using Style = Series::Style;
  Plot plot{
      .title = "Grids a second on one Cortex-A9 at 1 GHz, ours modelled, whole frame (table 4.4)",
      .x_label = "ibeo LUX",
      .y_label = "Hz",
      .series = {}};
  Series paper{.name = "thesis", .points = {}, .style = Style::kBars};
  const Series scanners{.name = "the scanners, 25 Hz",
                        .points = {{1.6, kScannersHz}, {4.4, kScannersHz}},
                        .style = Style::kLine};
  for (const Rate& rate : scenes.matched.rates) {
    const int sensors = rate.frame.sensors;
    paper.points.emplace_back(sensors, rate.paper_hz);
    plot.x_names.emplace_back(sensors, std::to_string(sensors));
  }
  plot.series.push_back(paper);
  for (const Scene* scene : {&scenes.matched, &scenes.city}) {
    for (const double per_cycle : {kSlow, kQuick}) {
      Series series{.name = scene->words + ", " + fixed(per_cycle, 1) + " instructions a cycle",
                    .points = {},
                    .style = Style::kBars};
      for (const Rate& rate : scene->rates) {
        series.points.emplace_back(rate.frame.sensors, modelled_hz(rate.frame.whole, per_cycle));
      }
      plot.series.push_back(series);
    }
  }
  plot.series.push_back(scanners);
  return plot;
}

// "2 LUX 61.9 Hz, short of the thesis's 66; ..."
std::string verdicts_in_words(const std::vector<Rate>& rates) {
  std::string words;
  for (const Rate& rate : rates) {
    const double slow = modelled_hz(rate.frame.whole, kSlow);
    words.append(words.empty() ? "" : "; ").append(std::to_string(rate.frame.sensors));
    words.append(" LUX ").append(fixed(slow, 1)).append(" Hz, ");
    words.append(verdict_on(rate.paper_hz, slow) == Verdict::kBeats ? "better than" : "short of");
    words.append(" the thesis's ").append(fixed(rate.paper_hz, 0));
  }
  return words;
}

void describe_growth(const std::vector<Rate>& rates, Markdown& body) {
  const auto growth = [&rates](std::size_t place) {
    return percent(rates[place].frame.whole / rates[place - 1].frame.whole - 1, 0);
  };
  body.paragraph(
      "By table 4.4 a LUX takes the thesis " + fixed(1000 / 66.0 / 2, 1) +
      " ms in the first two, " + fixed(1000 / 47.0 - 1000 / 66.0, 1) + " ms as the third and " +
      fixed(1000 / 28.0 - 1000 / 47.0, 1) +
      " ms as the fourth, for which it gives no reason. On the ring road the third adds " +
      growth(1) + " and the fourth " + growth(2) + "; in the thesis they add " +
      percent(66.0 / 47.0 - 1, 0) + " and " + percent(47.0 / 28.0 - 1, 0) + ".");
}

void describe_rates(const TablesInput& input, const Scenes& scenes, Markdown& body) {
  body.subheading("Grids a second: table 4.4");
  body.paragraph(
      "Instructions a frame, measured: every instruction that the emulated Cortex-A9 executes "
      "(`bench/cortex_a9.txt`, written by `bench/measure_a9`), mean of " +
      grouped(measured_on_a9("frame_cost scene=ring_road sensors=4", "frames")) +
      " frames, two, three or all four LUX of the reference car. *Whole frame* is receiving, "
      "fusing, marking and publishing: finding, hashing, wrapping and clearing the known tiles.");
  print_instructions(scenes, body);
  body.paragraph(
      "Grids a second at 1 GHz, **modelled**: those counts by an assumed number of instructions a "
      "cycle, 0.5 or 1.0, as in [figures.md](figures.md); QEMU, which counts them, has no caches "
      "and no pipeline.");
  print_rates(scenes, body);
  body.picture(draw(input, "output_rates.svg", plot_of(scenes)),
               "Grids a second by the number of LUX");
  body.paragraph("The verdicts are those of the whole mean frame on the ring road at 0.5: " +
                 verdicts_in_words(scenes.matched.rates) +
                 ". The thesis timed how its scan points become a grid that starts from 0; it does "
                 "not say whether setting the grid to 0 or sending it is in its rates. Fuse + mark "
                 "+ clear is what compares with it at all events, the whole frame is what a "
                 "receiver waits for and the stricter of the two. Decoding and checking the "
                 "sensors' messages are in both.");
  describe_growth(scenes.matched.rates, body);
}

}  // namespace

Section output_rates(const TablesInput& input) {
  const Scenes scenes;
  const A9Frame& four = scenes.matched.rates.back().frame;
  Section section;
  for (const Rate& rate : scenes.matched.rates) {
    section.claims.push_back(claim_on_rate(rate));
  }
  section.claims.push_back(claim_on_real_time(four));
  section.body.heading("Output rates: tables 4.4 and 4.5");
  describe_loads(scenes, section.body);
  describe_rates(input, scenes, section.body);
  add_points_cells_hz(four, section);
  return section;
}

}  // namespace iog::tools
