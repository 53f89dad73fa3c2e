// What this project set out to reach on one Cortex-A9, what is reached, and how far both are from
// what the memory alone would allow.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "lab/experiments/a9_cycles.hpp"
#include "lab/experiments/a9_frame.hpp"
#include "lab/experiments/peer_ratios.hpp"
#include "lab/experiments/sections.hpp"
#include "lab/scenarios/worst_frames.hpp"

namespace iog::lab {
namespace {

constexpr double kClockHz = 1e9;
constexpr int kSensors = 4;
constexpr double kPrintedInstructions = 29.2e6;  // the thesis's printed algorithm, matched load

// Why a goal is missed: said by whoever knows, printed where it is missed.
struct Reasons {
  const char* matched =
      "turning points to beams takes three quarters of what carving takes, see where the cycles go";
  const char* city = "turning points to beams takes more than carving, see where the cycles go";
  const char* matched_without_paths = "a line that is not kept is found anew, block by block";
  const char* worst = "no azimuth comes twice, so every line is found anew, block by block";
  const char* whole =
      "fusing takes half of it; of the rest, most is the CRCs of tiles and messages";
  const char* whole_shortest =
      "publishing takes more than fusing: finding runs of cells and writing them, and the CRCs";
  const char* quadtree = "of the cycles, two thirds are fusing";
  const char* instructions = "two in five of them turn points to beams, see where the cycles go";
  const char* peers = "see docs/peers.md";
};
constexpr Reasons kReasons;

// A goal of which more is better, in Hz at 1 GHz.
struct RateGoal {
  std::string what;
  double hz = 0;
  Modelled found;
  double floor_cycles = 0;
  StageCost cost;  // of what was found
  const char* reason = nullptr;
};

std::string verdict_of(double goal, double found, bool more_is_better, const std::string& reason) {
  if (more_is_better ? found >= goal : found <= goal) {
    return "met";
  }
  const double short_by = more_is_better ? 1 - found / goal : found / goal - 1;
  return std::string(more_is_better ? "**short by " : "**over by ")
      .append(percent(short_by, 0))
      .append("**: ")
      .append(reason);
}

// What the model finds for its frames, at the instructions that were counted of all frames. Those
// were counted with what is kept; without, there are as many more as the model finds more.
StageCost fused_cost(const A9Frame& frame, const A9Cycles& kept, const A9Cycles& cycles) {
  StageCost cost = cycles.fused;
  cost.instructions = frame.fused * cycles.fused.instructions / kept.fused.instructions;
  cost.cycles = cycles_of(cost.instructions, cycles.fused);
  return cost;
}

RateGoal fuse_goal(const char* what, double hz, const char* scene, Paths paths,
                   const char* reason) {
  const StageCost cost = fused_cost(a9_frame(scene, kSensors), a9_cycles(scene, kSensors),
                                    a9_cycles(scene, kSensors, paths));
  return {.what = what,
          .hz = hz,
          .found = hz_of(cost.cycles),
          .floor_cycles = a9_floor(scene).fused_cycles(),
          .cost = cost,
          .reason = reason};
}

// The dearest of the kinds by the nominal variant, with paths or without, whichever is dearer.
RateGoal worst_goal() {
  RateGoal worst{
      .what = "", .hz = 180, .found = {}, .floor_cycles = 0, .cost = {}, .reason = kReasons.worst};
  for (const WorstFrame& kind : all_worst_frames()) {
    for (const Paths paths : {Paths::kKept, Paths::kForgotten}) {
      const StageCost cost = fused_cost(a9_worst_frame(kind.name), a9_worst_cycles(kind.name),
                                        a9_worst_cycles(kind.name, paths));
      if (cost.cycles.nominal > worst.cost.cycles.nominal) {
        worst.what =
            std::string("worst constructed frame, any path (`").append(kind.name).append("`)");
        worst.cost = cost;
        worst.found = hz_of(cost.cycles);
        worst.floor_cycles = a9_worst_floor(kind.name).fused_cycles();
      }
    }
  }
  return worst;
}

RateGoal whole_goal() {
  const A9Frame frame = a9_frame("ring_road", kSensors);
  StageCost cost = a9_cycles("ring_road", kSensors).whole;
  cost.cycles = cycles_of(frame.whole, cost);
  cost.instructions = frame.whole;
  return {.what = "matched load, from packet to last tile sent, raw",
          .hz = 250,
          .found = hz_of(cost.cycles),
          .floor_cycles = a9_floor("ring_road").whole_cycles(),
          .cost = cost,
          .reason = kReasons.whole};
}

// As the firmware sends them. Without messages that are as short as can be there is no floor but
// that of fusing.
RateGoal whole_shortest_goal() {
  const StageCost cost = a9_shortest("ring_road").whole;
  return {.what = "the same, each tile in its shortest encoding",
          .hz = 250,
          .found = hz_of(cost.cycles),
          .floor_cycles = a9_floor("ring_road").fused_cycles(),
          .cost = cost,
          .reason = kReasons.whole_shortest};
}

// The tree is built from the tiles of the grid, after marking.
RateGoal tree_goal() {
  RateGoal goal = fuse_goal("matched load, fuse + linear quadtree (thesis: 5 Hz)", 200, "ring_road",
                            Paths::kKept, kReasons.quadtree);
  goal.cost = sum_of({goal.cost, a9_tree("ring_road").cost});
  goal.found = hz_of(goal.cost.cycles);
  return goal;
}

std::vector<RateGoal> rate_goals() {
  return {fuse_goal("matched load, best path", 600, "ring_road", Paths::kKept, kReasons.matched),
          fuse_goal("city drive, best path", 1000, "city", Paths::kKept, kReasons.city),
          fuse_goal("matched load, without tables per line", 320, "ring_road", Paths::kForgotten,
                    kReasons.matched_without_paths),
          worst_goal(),
          whole_goal(),
          whole_shortest_goal(),
          tree_goal()};
}

void print_rates(Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const RateGoal& goal : rate_goals()) {
    const double floor_hz = kClockHz / goal.floor_cycles;
    rows.push_back({goal.what, std::string("≥ ").append(grouped(goal.hz)).append(" Hz"),
                    banded(goal.found, 0) + " Hz", grouped(floor_hz) + " Hz",
                    fixed(floor_hz / goal.found.nominal, 1), grouped(goal.cost.instructions),
                    grouped(goal.cost.l1d_refills), grouped(goal.cost.l2_misses),
                    verdict_of(goal.hz, goal.found.nominal, true, goal.reason)});
  }
  body.table({"", "goal", "found, modelled", "floor", "times below it", "instructions",
              "L1D refills", "L2 misses", "verdict"},
             rows);
}

void print_instructions(Markdown& body) {
  constexpr double kMost = 1.9e6;
  const A9Frame frame = a9_frame("ring_road", kSensors);
  const StageCost fused = a9_cycles("ring_road", kSensors).fused;
  body.table(
      {"", "goal", "found, measured", "L1D refills, modelled", "L2 misses, modelled", "verdict"},
      {{"instructions a frame, matched load, fuse and clear",
        std::string("≤ ").append(grouped(kMost)), grouped(frame.fused), grouped(fused.l1d_refills),
        grouped(fused.l2_misses), verdict_of(kMost, frame.fused, false, kReasons.instructions)}});
  body.paragraph("By prototypes of this project the thesis's printed algorithm takes " +
                 grouped(kPrintedInstructions) + " instructions at that load, " +
                 fixed(kPrintedInstructions / frame.fused, 1) + " times as many.");
}

void print_peers(Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const PeerRatio& ratio : peer_ratios()) {
    const double fewer = std::min(ratio.city, ratio.ring_road);
    rows.push_back({"on this PC, against " + ratio.peer + ", " + ratio.what,
                    std::string("≥ ").append(grouped(ratio.goal)).append(" ×"),
                    fixed(ratio.city, 2) + " ×", fixed(ratio.ring_road, 2) + " ×",
                    verdict_of(ratio.goal, fewer, true, kReasons.peers)});
  }
  body.table({"", "goal", "city", "ring road", "verdict"}, rows);
}

std::vector<std::string> floor_row(const std::string& name, const A9Floor& floor,
                                   const A9Cycles& ours) {
  return {name,
          grouped(floor.lines),
          grouped(floor.fuse.cycles.nominal),
          grouped(floor.clear.cycles.nominal),
          grouped(floor.send.cycles.nominal),
          grouped(kClockHz / floor.fused_cycles()),
          grouped(kClockHz / floor.whole_cycles()),
          fixed(ours.fused.cycles.nominal / floor.fused_cycles(), 1),
          fixed(ours.whole.cycles.nominal / floor.whole_cycles(), 1)};
}

void describe_floor(Markdown& body) {
  body.subheading("The physical floor");
  body.paragraph(
      "Whatever a core computes: each line of 32 bytes of the grid in which a frame leaves "
      "something known must be read and written once to get there, read once more to be sent, and "
      "written once to be cleared. `lab/target/floor.cpp` does that, with NEON and prefetch, and "
      "nothing "
      "else, with the very lines of the frames; the cost model says what it takes. *Sent* is "
      "copied into a message buffer. What a core must compute to know the lines is not in it, nor "
      "are packets. Nominal cycles a frame; ours are those of the same frames:");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [scene, name] :
       {std::pair("ring_road", "ring road"), std::pair("city", "city")}) {
    rows.push_back(floor_row(name, a9_floor(scene), a9_cycles(scene, kSensors)));
  }
  for (const WorstFrame& kind : all_worst_frames()) {
    rows.push_back(floor_row(std::string("`").append(kind.name).append("`"),
                             a9_worst_floor(kind.name), a9_worst_cycles(kind.name)));
  }
  body.table({"frames", "lines", "read and write", "clear", "send", "Hz without sending",
              "Hz with it", "fuse + mark + clear takes, times", "whole frame, times"},
             rows);
}

}  // namespace

Section goals(const TablesInput& /*input*/) {
  Section section;
  section.body.heading("Goals on one Cortex-A9");
  section.body.paragraph(
      "What this project set out to reach, at 1 GHz on one core, with the rule hits_win. *Fuse* is "
      "decoding, fusing, marking and clearing. Rates are **modelled**, the nominal variant decides "
      "([a9_model.md](a9_model.md)); in parentheses are the pessimistic and the optimistic one. "
      "The "
      "*floor* is what the memory alone asks for, below.");
  print_rates(section.body);
  print_instructions(section.body);
  section.body.paragraph(
      "Ratios of times on a PC are those of [peers.md](peers.md), which also says that none of "
      "these libraries does the same work; the scene with the smaller ratio decides:");
  print_peers(section.body);
  describe_floor(section.body);
  return section;
}

}  // namespace iog::lab
