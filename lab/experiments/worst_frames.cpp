// The worst frames that could be put together, beside those of a drive, and the bound above both.
#include "lab/scenarios/worst_frames.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lab/experiments/a9_cycles.hpp"
#include "lab/experiments/a9_frame.hpp"
#include "lab/experiments/cortex_a9.hpp"
#include "lab/experiments/frame_bound.hpp"
#include "lab/experiments/sections.hpp"
#include "lidar/ibeo_lux.hpp"
#include "tools/simulate/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

constexpr int kSensors = 4;
constexpr double kMsPerS = 1e3;
constexpr double kClockHz = 1e9;

const tools::CatalogueEntry& car() { return tools::find_vehicle(tools::kDefaultVehicle); }

double period_s() { return car().vehicle->frame_period_us / 1e6; }

// A line of the table.
struct Row {
  std::string name;
  bool is_forged = false;
  double marks = 0;  // of a frame
  A9Frame cost;      // counted
  A9Cycles cycles;   // modelled
  A9Floor floor;

  [[nodiscard]] Modelled fused_hz() const { return hz_of(cycles_of(cost.fused, cycles.fused)); }
  // What the largest frame takes, in seconds.
  [[nodiscard]] Modelled largest_s() const {
    return cycles_of(cost.largest, cycles.whole) * (1 / kClockHz);
  }
};

std::size_t marks_of(const tools::CapturedDatagram& datagram) {
  const vehicle::Sensor& sensor =
      car().vehicle->sensors[tools::sensor_of_port(car(), datagram.destination.port)];
  lidar::IbeoLux decoder;
  if (decoder.decode(datagram.payload) != lidar::DecodeStatus::kOk) {
    return 0;
  }
  std::size_t marks = 0;
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    const vehicle::Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
    marks += vehicle::classify(sensor, beam, point).marks ? 1U : 0U;
  });
  return marks;
}

std::size_t marks_of(const std::vector<tools::CapturedDatagram>& frame) {
  std::size_t marks = 0;
  for (const tools::CapturedDatagram& datagram : frame) {
    marks += marks_of(datagram);
  }
  return marks;
}

Row row_of(const tools::SceneEntry& scene) {
  tools::Drive drive(car(), kA9Seed, kA9Seconds, scene);
  std::size_t marks = 0;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    drive.move_to(frame);
    marks += marks_of(drive.datagrams());
  }
  return {.name = std::string(scene.name),
          .is_forged = false,
          .marks = static_cast<double>(marks) / drive.frame_count(),
          .cost = a9_frame(scene.name, kSensors),
          .cycles = a9_cycles(scene.name, kSensors),
          .floor = a9_floor(scene.name)};
}

Row row_of(const WorstFrame& worst) {
  const double frames = measured_on_a9("frame_cost worst=" + std::string(worst.name), "frames");
  std::size_t marks = 0;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    marks += marks_of(worst_datagrams(worst, kA9Seed, frame));
  }
  return {.name = std::string(worst.name),
          .is_forged = worst.is_forged,
          .marks = static_cast<double>(marks) / frames,
          .cost = a9_worst_frame(worst.name),
          .cycles = a9_worst_cycles(worst.name),
          .floor = a9_worst_floor(worst.name)};
}

std::vector<Row> all_rows() {
  std::vector<Row> rows;
  for (const tools::SceneEntry& scene : tools::all_scenes()) {
    rows.push_back(row_of(scene));
  }
  for (const WorstFrame& worst : all_worst_frames()) {
    rows.push_back(row_of(worst));
  }
  return rows;
}

void print_kinds(Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const WorstFrame& worst : all_worst_frames()) {
    rows.push_back({std::string(worst.name), std::string(worst.strain),
                    worst.is_forged ? "forged" : "a LUX could"});
  }
  body.table({"frame", "what it is hard on", "who could send it"}, rows);
}

void print_costs(const std::vector<Row>& rows, Markdown& body) {
  std::vector<std::vector<std::string>> cells;
  for (const Row& row : rows) {
    const A9Frame& cost = row.cost;
    cells.push_back({row.name, grouped(cost.points), grouped(cost.cells), grouped(row.marks),
                     grouped(cost.tiles), grouped(cost.fused), grouped(cost.whole),
                     grouped(cost.largest), grouped(row.cycles.whole.l1d_refills),
                     grouped(row.cycles.whole.l2_misses)});
  }
  body.table({"frame", "points", "cells carved", "marks", "known tiles", "fuse + mark + clear",
              "whole frame", "largest frame", "L1D refills", "L2 misses"},
             cells);
}

void print_rates(const std::vector<Row>& rows, Markdown& body) {
  std::vector<std::vector<std::string>> cells;
  for (const Row& row : rows) {
    const double floor_hz = kClockHz / row.floor.fused_cycles();
    const Modelled fused = row.fused_hz();
    cells.push_back({row.name, banded(fused, 0), grouped(floor_hz),
                     fixed(floor_hz / fused.nominal, 1), banded(row.largest_s() * kMsPerS, 1),
                     percent(row.largest_s().nominal / period_s(), 0)});
  }
  body.table({"frame", "fuse + mark + clear, Hz", "floor, Hz", "times below it",
              "largest frame, ms", "of 40 ms"},
             cells);
}

void describe_frames(const std::vector<Row>& rows, Markdown& body) {
  body.paragraph(
      "A drive says what a frame costs on average. What it may cost is asked here: frames that "
      "are no scenes but scans put together point by point, each hard on another part of the "
      "fusion (`worst_frames`). Every point of them is believed, and no scan has more points than "
      "the description of the reference car allows. Some a LUX could send; others are *forged*: "
      "the format allows them, so whoever promises a time has to count with them. A forged frame "
      "uses only the two upper layers, of whose 49 m the height band cuts nothing off; the lower "
      "two leave it after 31 m and 10 m.");
  print_kinds(body);
  body.paragraph(
      "Instructions a frame, measured on the emulated Cortex-A9 like those of the output rates: " +
      grouped(measured_on_a9("frame_cost worst=flood", "frames")) +
      " frames of each kind, four LUX. L1D refills and L2 misses of a mean whole frame are "
      "modelled:");
  print_costs(rows, body);
  body.paragraph(
      "At 1 GHz, **modelled**: those counts at the instructions a cycle that the cost model finds "
      "for " +
      grouped(rows.back().cycles.frames) +
      " frames of each kind. The floor is what the memory alone asks for (see the goals). The last "
      "column is the largest frame's share of the 40 ms between two scans.");
  print_rates(rows, body);
}

// Of the whole frames: each variant's fewest.
Modelled fewest_per_cycle(const std::vector<Row>& rows) {
  const auto fewest = [&rows](double Modelled::*variant) {
    const auto per_cycle = [variant](const Row& row) {
      return row.cycles.whole.instructions / row.cycles.whole.cycles.*variant;
    };
    return per_cycle(*std::ranges::min_element(rows, {}, per_cycle));
  };
  return {.nominal = fewest(&Modelled::nominal),
          .optimistic = fewest(&Modelled::optimistic),
          .pessimistic = fewest(&Modelled::pessimistic)};
}

void describe_bound(const FrameBound& bound, const std::vector<Row>& rows, Markdown& body) {
  const auto fused = [](const Row& row) { return row.cost.fuse + row.cost.mark; };
  const Row& dearest = *std::ranges::max_element(rows, {}, fused);
  const Modelled per_cycle = fewest_per_cycle(rows);
  const double instructions_ms = bound.whole() / kClockHz * kMsPerS;
  const Modelled bound_ms{.nominal = instructions_ms / per_cycle.nominal,
                          .optimistic = instructions_ms / per_cycle.optimistic,
                          .pessimistic = instructions_ms / per_cycle.pessimistic};
  const double of_its_points = bound.fuse_and_mark() * dearest.cost.points / bound.points;
  body.subheading("The bound");
  body.paragraph(
      "Counts times costs: what no frame of the reference car can exceed as long as no point, "
      "cell, mark or tile costs more than the dearest of those measured. The counts follow from "
      "the constants of the code. A scan of more points than its sensor's description allows is "
      "refused, which "
      "leaves " +
      grouped(bound.points) + " points a frame. A line of length L crosses at most L sqrt(2) / " +
      fixed(geometry::kCellMm / 1000.0, 2) +
      " m + 2 borders of cells and carves as many cells and one, which for 50 m is " +
      grouped(bound.cells_per_beam) + " a beam and " + grouped(bound.cells) +
      " a frame. A point marks one cell. A grid has " + grouped(bound.tiles) +
      " tiles. The costs are the largest that the frames above show: " + fixed(bound.per_point, 0) +
      " instructions a point (`short_beams`), " + fixed(bound.per_cell, 1) + " a cell, " +
      fixed(bound.per_mark, 1) + " a mark, " + grouped(bound.per_tile) +
      " a known tile from finding to clearing it, and " + grouped(bound.receive) +
      " to receive the packets in which so many points come.");
  body.paragraph(
      "Fusing and marking are then at most " + grouped(bound.fuse_and_mark()) +
      " instructions. The dearest of the constructed frames, `" + dearest.name + "`, takes " +
      grouped(fused(dearest)) + ", " + percent(fused(dearest) / of_its_points, 1) +
      " of what the bound is for its points; where there are more, beams share lines, "
      "which the bound does not count on. With every tile published a whole frame is at most " +
      grouped(bound.whole()) + ", which at the fewest instructions a cycle of all these frames, " +
      banded(per_cycle, 2) + ", takes " + banded(bound_ms, 0) +
      " ms, modelled. The bound is on instructions: how many a cycle there are depends on "
      "the caches as well, and packets with few points or none are bounded by the "
      "Ethernet line, not by a scan.");
}

// "a, b and c" of the frames for which this holds.
template <typename Holds>
std::string names_of(const std::vector<Row>& rows, Holds&& holds) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (holds(row)) {
      names.push_back("`" + row.name + "`");
    }
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  }
  return text.empty() ? "none" : text;
}

void describe_real_time(const std::vector<Row>& rows, Markdown& body) {
  const auto late = [&rows](bool is_forged, double Modelled::*variant) {
    return names_of(rows, [&](const Row& row) {
      return row.is_forged == is_forged && row.largest_s().*variant > period_s();
    });
  };
  body.paragraph(
      "What breaks real time, 25 Hz at 1 GHz, modelled: of the frames that a LUX could send " +
      late(false, &Modelled::nominal) + ", by the pessimistic variant " +
      late(false, &Modelled::pessimistic) + "; of the forged ones " +
      late(true, &Modelled::nominal) + ", by the pessimistic variant " +
      late(true, &Modelled::pessimistic) +
      ". Packets then wait in the receive ring, and a frame whose packets are not all "
      "fused when its period is over is sent without the others and says so. What "
      "comes after that, or finds the ring full, is dropped and counted. No grid is "
      "wrong, but it lacks points.");
}

}  // namespace

Section worst_frames(const TablesInput& /*input*/) {
  const std::vector<Row> rows = all_rows();
  Section section;
  section.body.heading("Worst frames");
  describe_frames(rows, section.body);
  describe_bound(frame_bound(), rows, section.body);
  describe_real_time(rows, section.body);
  return section;
}

}  // namespace iog::lab
