// Table 4.4 of the thesis: grids a second on one Cortex-A9, at the load that its table 4.7 implies;
// table 4.5, what that is worth, follows.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lab/experiments/a9_cycles.hpp"
#include "lab/experiments/a9_frame.hpp"
#include "lab/experiments/cortex_a9.hpp"
#include "lab/experiments/points_cells_hz.hpp"
#include "lab/experiments/scene_load.hpp"
#include "lab/experiments/sections.hpp"

namespace iog::lab {
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
  A9Frame frame;    // counted
  A9Cycles cycles;  // modelled

  [[nodiscard]] Modelled fused_hz() const { return hz_of(cycles_of(frame.fused, cycles.fused)); }
  [[nodiscard]] Modelled whole_hz() const { return hz_of(cycles_of(frame.whole, cycles.whole)); }
  [[nodiscard]] Modelled largest_hz() const {
    return hz_of(cycles_of(frame.largest, cycles.whole));
  }
};

struct Scene {
  std::string words;
  SceneLoad load;
  std::vector<Rate> rates;  // as kTable44
};

Scene scene_of(const char* name, const char* words) {
  Scene scene{.words = words, .load = load_of(name, kA9Seed, kA9Seconds), .rates = {}};
  for (const PaperRate& paper : kTable44) {
    scene.rates.push_back({.paper_hz = paper.hz,
                           .frame = a9_frame(name, paper.sensors),
                           .cycles = a9_cycles(name, paper.sensors)});
  }
  return scene;
}

// The load at which the thesis is compared with, and a lighter one beside it.
struct Scenes {
  Scene matched = scene_of("ring_road", "ring road");
  Scene city = scene_of("city", "city");
};

// What another variant of the model would have said of a verdict.
std::string doubt_on(double paper, const Modelled& ours) {
  return is_in_band(paper, ours) ? "; not by all variants of the model" : "";
}

Claim claim_on_rate(const Rate& rate) {
  const Modelled whole = rate.whole_hz();
  return {.place = "table 4.4",
          .what = "grids a second with " + std::to_string(rate.frame.sensors) + " LUX",
          .paper = fixed(rate.paper_hz, 0) + " Hz",
          .ours = banded(whole, 1) + " Hz, modelled",
          .verdict = verdict_by_nominal(rate.paper_hz, whole),
          .reason = "on a ring road, taken for the thesis's load" + doubt_on(rate.paper_hz, whole) +
                    "; without receiving and sending " + banded(rate.fused_hz(), 1) + " Hz"};
}

Claim claim_on_real_time(const Rate& rate) {
  const Modelled slowest = rate.largest_hz();
  const bool is_in_time = slowest.nominal > kScannersHz;
  const std::string doubt = doubt_on(kScannersHz, slowest);
  return {.place = "table 4.4",
          .what = "four LUX in real time, 25 Hz",
          .paper = "28 Hz on average",
          .ours = banded(slowest, 1) + " Hz in the largest frame, modelled",
          .verdict = is_in_time ? Verdict::kEquals : Verdict::kFallsShort,
          .reason = is_in_time && doubt.empty() ? "" : "on a ring road" + doubt};
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
                      grouped(frame.whole), grouped(frame.largest),
                      grouped(rate.cycles.whole.l1d_refills),
                      grouped(rate.cycles.whole.l2_misses)});
    }
  }
  body.table({"scene", "LUX", "scan points", "carve and mark", "cells carved",
              "fuse + mark + clear", "whole frame", "largest frame", "L1D refills", "L2 misses"},
             rows);
}

void print_rates(const Scenes& scenes, Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const Scene* scene : {&scenes.matched, &scenes.city}) {
    for (const Rate& rate : scene->rates) {
      rows.push_back({scene->words, std::to_string(rate.frame.sensors), fixed(rate.paper_hz, 0),
                      banded(rate.fused_hz(), 1), banded(rate.whole_hz(), 1),
                      banded(rate.largest_hz(), 1)});
    }
  }
  body.table({"scene", "LUX", "paper, Hz", "fuse + mark + clear, Hz", "whole frame, Hz",
              "largest frame, Hz"},
             rows);
}

std::vector<std::string> stage_row(const std::string& name, const StageCost& stage) {
  return {name,
          grouped(stage.instructions),
          banded(stage.cycles, 0),
          fixed(stage.instructions / stage.cycles.nominal, 2),
          grouped(stage.l1d_refills),
          grouped(stage.l2_misses),
          grouped(stage.mispredicts)};
}

void print_stages(const Rate& four, Markdown& body) {
  const A9Cycles& cycles = four.cycles;
  body.table({"stage", "instructions", "cycles", "instructions a cycle", "L1D refills", "L2 misses",
              "mispredictions"},
             {stage_row("receive", cycles.receive), stage_row("decode", cycles.decode),
              stage_row("to beams", cycles.beams), stage_row("carve", cycles.carve),
              stage_row("mark", cycles.mark), stage_row("encode", cycles.encode),
              stage_row("send", cycles.send), stage_row("clear", cycles.clear),
              stage_row("whole frame", cycles.whole)});
}

// "-3.9 %" of the whole mean frame, by looking at more of them.
std::string change_over_long_run(const Scene& scene, const std::string& name) {
  const double first = scene.rates.back().cycles.whole.cycles.nominal;
  const double change = a9_long_run(name).whole.cycles.nominal / first - 1;
  return std::string(change < 0 ? "" : "+").append(percent(change, 1));
}

void describe_stages(const Scenes& scenes, Markdown& body) {
  body.subheading("Where the cycles go");
  const A9Cycles& cycles = scenes.matched.rates.back().cycles;
  body.paragraph(
      "A mean frame of four LUX, modelled: " + grouped(cycles.frames) + " frames after " +
      grouped(cycles.before) +
      " to warm up; all but the bounds of the cycles are those of the nominal "
      "variant. An instruction belongs to the innermost of the functions named here that it is "
      "called from, so that the stages add up. *Receive* reads Ethernet, IP and UDP; *decode* "
      "finds and checks the sensors' messages (`FrameEngine::receive`); *to beams* turns points "
      "to beams: fate, line, which index ends where (`FrameEngine::fuse` without carving); *carve* "
      "lowers the cells along them; *mark* adds what they hit (`FrameFusion::finish`); *encode* "
      "finds the known tiles, copies and hashes them and writes their headers (the pipeline itself "
      "and what it calls); *send* wraps them into Ethernet frames (`net::build_message`); *clear* "
      "sets them back to unknown. Reading the stopwatch is in none of them.");
  for (const Scene* scene : {&scenes.matched, &scenes.city}) {
    body.paragraph((scene == &scenes.matched ? "Ring road:" : "City:"));
    print_stages(scene->rates.back(), body);
  }
  body.paragraph("Over the " + grouped(a9_long_run("city").frames) +
                 " frames after these instead, the nominal cycles of a whole mean frame change "
                 "by " +
                 change_over_long_run(scenes.matched, "ring_road") + " on the ring road and by " +
                 change_over_long_run(scenes.city, "city") + " in the city.");
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
  const auto add = [&plot](const Scene& scene, const std::string& variant,
                           double Modelled::*member) {
    Series series{.name = scene.words + ", " + variant, .points = {}, .style = Style::kBars};
    for (const Rate& rate : scene.rates) {
      series.points.emplace_back(rate.frame.sensors, rate.whole_hz().*member);
    }
    plot.series.push_back(series);
  };
  add(scenes.matched, "pessimistic", &Modelled::pessimistic);
  add(scenes.matched, "nominal", &Modelled::nominal);
  add(scenes.matched, "optimistic", &Modelled::optimistic);
  add(scenes.city, "nominal", &Modelled::nominal);
  plot.series.push_back(scanners);
  return plot;
}

// "2 LUX 61.9 Hz, short of the thesis's 66; ..."
std::string verdicts_in_words(const std::vector<Rate>& rates) {
  std::string words;
  for (const Rate& rate : rates) {
    const Modelled whole = rate.whole_hz();
    const bool beats = verdict_by_nominal(rate.paper_hz, whole) == Verdict::kBeats;
    words.append(words.empty() ? "" : "; ").append(std::to_string(rate.frame.sensors));
    words.append(" LUX ").append(fixed(whole.nominal, 1)).append(" Hz, ");
    words.append(beats ? "better than" : "short of").append(" the thesis's ");
    words.append(fixed(rate.paper_hz, 0));
    if (is_in_band(rate.paper_hz, whole)) {
      words.append(", though not by every variant");
    }
  }
  return words;
}

void describe_growth(const std::vector<Rate>& rates, Markdown& body) {
  const auto growth = [&rates](std::size_t place) {
    return percent(rates[place - 1].whole_hz().nominal / rates[place].whole_hz().nominal - 1, 0);
  };
  body.paragraph(
      "By table 4.4 a LUX takes the thesis " + fixed(1000 / 66.0 / 2, 1) +
      " ms in the first two, " + fixed(1000 / 47.0 - 1000 / 66.0, 1) + " ms as the third and " +
      fixed(1000 / 28.0 - 1000 / 47.0, 1) +
      " ms as the fourth, for which it gives no reason. On the ring road the third adds " +
      growth(1) + " of the nominal cycles and the fourth " + growth(2) +
      "; in the thesis they add " + percent(66.0 / 47.0 - 1, 0) + " and " +
      percent(47.0 / 28.0 - 1, 0) + ".");
}

void describe_rates(const TablesInput& input, const Scenes& scenes, Markdown& body) {
  body.subheading("Grids a second: table 4.4");
  body.paragraph(
      "Instructions a frame, measured: every instruction that the emulated Cortex-A9 executes "
      "(`lab/target/cortex_a9.txt`, written by `lab/target/measure_a9`), mean of " +
      grouped(measured_on_a9("frame_cost scene=ring_road sensors=4", "frames")) +
      " frames, two, three or all four LUX of the reference car. *Whole frame* is receiving, "
      "fusing, marking and publishing: finding, hashing, protecting, wrapping and clearing the "
      "known tiles, which are sent raw. "
      "L1D "
      "refills and L2 misses of the whole frame are modelled:");
  print_instructions(scenes, body);
  const Rate& four = scenes.matched.rates.back();
  const Modelled& cycles = four.cycles.whole.cycles;
  const Modelled per_cycle{.nominal = four.cycles.whole.instructions / cycles.nominal,
                           .optimistic = four.cycles.whole.instructions / cycles.optimistic,
                           .pessimistic = four.cycles.whole.instructions / cycles.pessimistic};
  body.paragraph(
      "Grids a second at 1 GHz, **modelled**: those counts at the instructions a cycle that the "
      "cost model of the Cortex-A9 finds for the first " +
      grouped(four.cycles.frames) +
      " frames of the same drive, with its caches and its memory ([a9_model.md](a9_model.md)). A "
      "number is that of the nominal variant, in parentheses those of the pessimistic and the "
      "optimistic one. For the whole frame of four LUX on the ring road the model finds " +
      banded(per_cycle, 2) +
      " instructions a cycle. What the model leaves out, the library's 64-bit divisions among it, "
      "would take cycles "
      "and "
      "save none, so that the rates are more likely too high than too low. The largest frame is "
      "taken to run at the rate of the mean "
      "one:");
  print_rates(scenes, body);
  body.picture(draw(input, "output_rates.svg", plot_of(scenes)),
               "Grids a second by the number of LUX");
  body.paragraph("The nominal variant decides, for the whole mean frame on the ring road: " +
                 verdicts_in_words(scenes.matched.rates) +
                 ". Where another variant would decide otherwise, it says so. The thesis timed how "
                 "its scan points become a grid that starts from 0; it does "
                 "not say whether setting the grid to 0 or sending it is in its rates. Fuse + mark "
                 "+ clear is what compares with it at all events, the whole frame is what a "
                 "receiver waits for and the stricter of the two. Decoding and checking the "
                 "sensors' messages are in both.");
  describe_growth(scenes.matched.rates, body);
  describe_stages(scenes, body);
}

}  // namespace

Section output_rates(const TablesInput& input) {
  const Scenes scenes;
  const Rate& four = scenes.matched.rates.back();
  Section section;
  for (const Rate& rate : scenes.matched.rates) {
    section.claims.push_back(claim_on_rate(rate));
  }
  section.claims.push_back(claim_on_real_time(four));
  section.body.heading("Output rates: tables 4.4 and 4.5");
  describe_loads(scenes, section.body);
  describe_rates(input, scenes, section.body);
  add_points_cells_hz(four.frame, four.cycles, section);
  return section;
}

}  // namespace iog::lab
