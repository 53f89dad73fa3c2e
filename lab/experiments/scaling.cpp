// What a frame costs one Cortex-A9 as its load grows: sensors, beams, range, cells, cell size; and
// where that stops being real time. Frames are synthetic (lab/target/scaling.cpp), cycles modelled.
#include <string>
#include <utility>
#include <vector>

#include "grid/frame_fusion.hpp"
#include "lab/experiments/a9_cycles.hpp"
#include "lab/experiments/sections.hpp"

namespace iog::lab {
namespace {

constexpr double kClockHz = 1e9;
constexpr double kMsPerS = 1e3;
constexpr double kPeriodMs = 40;  // 25 Hz

constexpr A9Load kBase{
    .cells_per_side = 1024, .cell_mm = 100, .sensors = 4, .azimuths = 201, .range_cm = 2500};

struct Point {
  double x = 0;
  std::string name;
  A9Scaling cost;

  [[nodiscard]] double fused_ms() const { return cost.fused.cycles.nominal / kClockHz * kMsPerS; }
  [[nodiscard]] double whole_ms() const { return cost.whole.cycles.nominal / kClockHz * kMsPerS; }
};

// One thing that grows, all else that of kBase unless said otherwise.
struct Sweep {
  std::string heading;
  std::string axis;
  std::string file;
  std::string note;
  std::vector<Point> points;
  bool has_trend = true;  // whether a line through the last two points says where 25 Hz ends
};

Point point_of(double x, const std::string& name, const A9Load& load) {
  return {.x = x, .name = name, .cost = a9_scaling(load)};
}

Sweep sensors() {
  Sweep sweep{.heading = "Sensors",
              .axis = "LUX",
              .file = "scaling_sensors.svg",
              .note = "The core takes " + std::to_string(vehicle::kMaxSensors) + " sensors.",
              .points = {}};
  for (int count = 1; count <= static_cast<int>(vehicle::kMaxSensors); ++count) {
    A9Load load = kBase;
    load.sensors = count;
    sweep.points.push_back(point_of(count, std::to_string(count), load));
  }
  return sweep;
}

Sweep beams() {
  Sweep sweep{.heading = "Beams",
              .axis = "beams of a LUX: four layers",
              .file = "scaling_beams.svg",
              .note = "Directions lie 2, 1, 0.5, 0.25 and 0.125 degrees apart; " +
                      grouped(static_cast<double>(grid::kMaxMarks)) +
                      " marks of a frame are what the core takes.",
              .points = {}};
  for (const int azimuths : {51, 101, 201, 401, 801}) {
    A9Load load = kBase;
    load.azimuths = azimuths;
    sweep.points.push_back(point_of(4 * azimuths, grouped(4 * azimuths), load));
  }
  return sweep;
}

Sweep range() {
  Sweep sweep{.heading = "Range",
              .axis = "range, m",
              .file = "scaling_range.svg",
              .note =
                  "Up to 50 m on the default grid, 100 m on one of 2048 x 2048 cells, where the "
                  "sensors are taken to see that far: the last step is one of the grid, too.",
              .points = {}};
  for (const int range_cm : {625, 1250, 2500, 3750, 5000}) {
    A9Load load = kBase;
    load.range_cm = range_cm;
    sweep.points.push_back(point_of(range_cm / 100.0, fixed(range_cm / 100.0, 2), load));
  }
  A9Load far = kBase;
  far.cells_per_side = 2048;
  far.range_cm = 10'000;
  sweep.points.push_back(point_of(100, "100 (2048 x 2048)", far));
  return sweep;
}

Sweep cells() {
  Sweep sweep{.heading = "Cells",
              .axis = "cells per side",
              .file = "scaling_cells.svg",
              .note =
                  "Cells of 10 cm, the same beams of 25 m; 512 x 512 cells, 25.6 m to each side, "
                  "cut off the longest of them. What grows is the memory and the search for known "
                  "tiles. 4096 x 4096 cells, 16 MiB, are the most that the core takes.",
              .points = {},
              .has_trend = false};
  for (const int side : {512, 1024, 2048, 4096}) {
    A9Load load = kBase;
    load.cells_per_side = side;
    sweep.points.push_back(point_of(side, std::to_string(side), load));
  }
  return sweep;
}

Sweep cell_size() {
  Sweep sweep{.heading = "Cell size",
              .axis = "side of a cell, cm",
              .file = "scaling_cell_size.svg",
              .note = "The same 102.4 m with 2048, 1024 and 512 cells a side.",
              .points = {},
              .has_trend = false};
  for (const auto& [cell_mm, side] :
       {std::pair(50, 2048), std::pair(100, 1024), std::pair(200, 512)}) {
    A9Load load = kBase;
    load.cell_mm = cell_mm;
    load.cells_per_side = side;
    sweep.points.push_back(point_of(cell_mm / 10.0, std::to_string(cell_mm / 10), load));
  }
  return sweep;
}

void print(const Sweep& sweep, Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const Point& point : sweep.points) {
    const A9Scaling& cost = point.cost;
    rows.push_back({point.name, grouped(cost.points), grouped(cost.messages),
                    grouped(cost.whole.instructions), grouped(cost.whole.l1d_refills),
                    grouped(cost.whole.l2_misses), fixed(point.fused_ms(), 2),
                    fixed(point.whole_ms(), 2), grouped(kMsPerS / point.whole_ms())});
  }
  body.table({sweep.axis, "points", "messages", "instructions", "L1D refills", "L2 misses",
              "fuse + mark + clear, ms", "whole frame, ms", "Hz"},
             rows);
}

Plot plot_of(const Sweep& sweep) {
  Plot plot{.title = "A frame on one Cortex-A9 at 1 GHz, modelled",
            .x_label = sweep.axis,
            .y_label = "ms",
            .series = {}};
  Series whole{.name = "whole frame", .points = {}, .style = Series::Style::kLineAndPoints};
  Series fused{.name = "fuse + mark + clear", .points = {}, .style = Series::Style::kLineAndPoints};
  for (const Point& point : sweep.points) {
    whole.points.emplace_back(point.x, point.whole_ms());
    fused.points.emplace_back(point.x, point.fused_ms());
  }
  const Series period{
      .name = "25 Hz",
      .points = {{sweep.points.front().x, kPeriodMs}, {sweep.points.back().x, kPeriodMs}},
      .style = Series::Style::kLine};
  plot.series = {whole, fused, period};
  return plot;
}

// By the line through the neighbours of 40 ms, or through the last two points.
double end_of_real_time(const std::vector<Point>& points) {
  std::size_t upper = points.size() - 1;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].whole_ms() > kPeriodMs) {
      upper = i;
      break;
    }
  }
  const Point& a = points[upper - 1];
  const Point& b = points[upper];
  return a.x + (kPeriodMs - a.whole_ms()) * (b.x - a.x) / (b.whole_ms() - a.whole_ms());
}

std::string sentence_on(const Sweep& sweep) {
  const auto late = [](const Point& point) { return point.whole_ms() > kPeriodMs; };
  const Point* dearest = &sweep.points.front();
  for (const Point& point : sweep.points) {
    dearest = point.whole_ms() > dearest->whole_ms() ? &point : dearest;
  }
  const std::string at =
      dearest->name + " (" + sweep.axis + "): " + fixed(dearest->whole_ms(), 1) + " ms";
  if (!sweep.has_trend) {
    return late(*dearest) ? "No longer real time at " + at + "."
                          : "Real time everywhere, the dearest at " + at + ".";
  }
  const std::string end = grouped(end_of_real_time(sweep.points));
  return late(*dearest) ? "Real time ends at about " + end + " (" + sweep.axis + ")."
                        : "Real time everywhere, the dearest at " + at +
                              "; by the last two points it would end at about " + end + ".";
}

}  // namespace

Section scaling(const TablesInput& input) {
  Section section;
  section.body.heading("Scaling");
  section.body.paragraph(
      "What a frame costs as its load grows. The frames are synthetic, so that no scene is in the "
      "way: LUX around a car, every beam of them meets something within the last tenth of one "
      "range, the four layers of a direction within 30 cm; nothing is cut off by the height band. "
      "Base: four LUX of 201 directions, 25 m, 1024 x 1024 cells of 10 cm; one thing at a time is "
      "changed. Instructions are counted; refills, misses and times at 1 GHz are **modelled**, "
      "nominal. *Whole frame* is decoding, fusing, marking and publishing, without reading "
      "Ethernet, "
      "IP and UDP; real time is 25 Hz, 40 ms.");
  for (const Sweep& sweep : {sensors(), beams(), range(), cells(), cell_size()}) {
    section.body.subheading(sweep.heading);
    print(sweep, section.body);
    section.body.picture(draw(input, sweep.file, plot_of(sweep)),
                         "Milliseconds a frame by " + sweep.axis);
    section.body.paragraph(sweep.note + " " + sentence_on(sweep));
  }
  return section;
}

}  // namespace iog::lab
