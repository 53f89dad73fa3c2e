// What a budget says to a person.
#include <iomanip>
#include <sstream>
#include <string_view>

#include "tools/budget/frame_budget.hpp"
#include "tools/budget/unit_costs.hpp"
#include "tools/program/fixed.hpp"

namespace iog::tools {
namespace {

std::string percent_of(double part, double whole) { return fixed(100 * part / whole, 0) + " %"; }

std::string line_of(const std::string& name, const FrameBudget& frame, double period_ms) {
  const FrameWork& work = frame.work;
  std::ostringstream text;
  text << std::fixed << std::setprecision(0) << "  " << std::left << std::setw(9) << name
       << std::right << std::setw(8)
       << work.points + work.turn_points + work.tilted_points + work.points_once +
              work.later_echoes + work.arc_steps
       << " points" << std::setw(6) << work.tiles << " tiles" << std::setw(6) << work.class_tiles
       << " of classes" << std::setprecision(1) << std::setw(9) << frame.ms << " ms, "
       << percent_of(frame.ms, period_ms) << " of the period"
       << (frame.ms > period_ms ? ": TOO SLOW" : "") << '\n';
  return text.str();
}

// " city +9.6 %, ring_road -5.2 %"
template <typename Frames, typename Cycles>
std::string errors_of(const Frames& frames, Cycles&& reckoned) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << std::showpos;
  for (const auto& frame : frames) {
    text << (text.tellp() > 0 ? ", " : "") << frame.name << ' '
         << 100 * (reckoned(frame) / (kMsPerCycle * frame.cycles) - 1) << " %";
  }
  return text.str();
}

}  // namespace

std::string words_of_budget(const CatalogueEntry& car) {
  const VehicleBudget budget = budget_of(car);
  std::ostringstream text;
  text << car.vehicle->name << ", a frame every " << budget.period_ms << " ms\n"
       << line_of("typical", budget.typical, budget.period_ms)
       << line_of("worst", budget.worst, budget.period_ms);
  if (budget.typical.work.ground_turns > 0) {
    text << std::fixed << std::setprecision(1)
         << "  in both, following the ground: " << ground_ms(budget.typical.work)
         << " ms of the typical frame\n";
  }
  if (budget.typical.work.moved_frames > 0) {
    text << std::fixed << std::setprecision(1)
         << "  in both, opening ground only from below: " << moved_ms(budget.typical.work)
         << " ms of the typical frame\n";
  }
  return text.str();
}

std::string warning_of_budget(const CatalogueEntry& car) {
  const VehicleBudget budget = budget_of(car);
  if (budget.typical.ms <= budget.period_ms) {
    return {};
  }
  return "warning: " + std::string(car.vehicle->name) +
         ": frame_period_us: a typical frame takes " + fixed(budget.typical.ms, 1) +
         " ms by the cost model, and the car wants one every " + fixed(budget.period_ms, 1) +
         " ms; the target will leave packets (iog budget)\n";
}

std::string line_of_cores(const CatalogueEntry& car) {
  const VehicleBudget budget = budget_of(car);
  std::ostringstream text;
  text << std::left << std::setw(16) << car.vehicle->name << std::fixed << std::setprecision(1)
       << " every " << budget.period_ms << " ms";
  const auto append = [&](std::string_view name, double ms) {
    const std::size_t cores = cores_for(ms, budget.period_ms);
    text << "; " << name << ' ' << ms << " ms, ";
    if (cores == 0) {
      text << "not on " << kShareOfCores.size() << " cores";
    } else {
      text << "on " << cores << (cores == 1 ? " core" : " cores");
    }
  };
  append("typical", budget.typical.ms);
  append("worst", budget.worst.ms);
  text << '\n';
  return text.str();
}

std::string words_of_budget_errors() {
  const auto whole = [](const ModelledFrame& frame) {
    return typical_ms({.points = frame.points, .cells = frame.cells, .tiles = frame.tiles});
  };
  const auto fused = [](const ModelledFrame& frame) {
    return typical_ms({.points = frame.points, .cells = frame.cells});
  };
  const auto turned = [](const ModelledTurn& turn) {
    return typical_ms({.turn_steps = kTurnSteps, .turn_points = turn.points, .tiles = turn.tiles});
  };
  const auto over_ground = [](const ModelledTurn& turn) {
    return typical_ms({.turn_steps = kTurnSteps,
                       .turn_points = turn.points,
                       .ground_turns = 1,
                       .ground_points = turn.points,
                       .tiles = turn.tiles});
  };
  const auto moved = [](const ModelledFramePart& frame) {
    return moved_ms({.moved_frames = 1, .moved_points = frame.points});
  };
  return "Modelled, not measured: one Cortex-A9 at 1 GHz, docs/a9_model.md, nominal variant, by "
         "lab/data/cortex_a9.csv.\n"
         "Off what the model says of whole frames of the reference car without classes: " +
         errors_of(kWholeFrames, whole) +
         ";\n"
         "of decoding and fusing alone, where tiles were sent raw: " +
         errors_of(kFusedFrames, fused) +
         ";\n"
         "of turns of units on a roof, by a height band: " +
         errors_of(kTurns, turned) +
         ";\n"
         "of the same where they follow the ground: " +
         errors_of(kGroundTurns, over_ground) +
         ";\n"
         "of what `moved` costs a frame with classes of these: " +
         errors_of(kMovedFrames, moved) +
         ".\n"
         "A step of the arc of a radar's or an ultrasonic unit's detection counts as a later echo, "
         "a "
         "point, and a cell of its cone as 30 cycles, which is reckoned; typical is half its "
         "range. "
         "A point of a unit that turns and is not level counts as of one that was modelled once, "
         "and "
         "`moved` of a unit that does not turn as of one that does.\n";
}

}  // namespace iog::tools
