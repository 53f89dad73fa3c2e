// Table I of the many-core paper: an occupancy grid cell by cell (CBC) and beam by beam (BBB).
#include <array>
#include <utility>
#include <vector>

#include "lab/experiments/experiments.hpp"
#include "lab/experiments/many_core/many_core_contest.hpp"

namespace iog::lab {
namespace {

std::array<const Contest*, 2> both(const Contests& contests) {
  return {&contests.fine, &contests.coarse};
}

// Sums over frames. Each model of a cell is fused into it.
Table operations(const Contests& contests) {
  Table table("many_core_operations",
              {"cell_m", "approach", "frames", "searches", "models_and_fusions", "cell_accesses"});
  for (const Contest* contest : both(contests)) {
    for (const auto& [approach, done] :
         {std::pair("CBC", contest->cbc()), std::pair("BBB", contest->bbb())}) {
      table.row(contest->cell_m(), approach, contests.frames, done.searches, done.models,
                done.accesses);
    }
  }
  return table;
}

Table differences(const Contests& contests) {
  Table table("many_core_differences",
              {"cell_m", "frames", "bbb_stop_behind_m", "differing_cells"});
  for (const Contest* contest : both(contests)) {
    table.row(contest->cell_m(), contests.frames, reference::kLuxStopBehindM,
              contest->differing_cells());
  }
  return table;
}

Table times(const DriveOutcome& outcome) {
  Table table("many_core_on_this_pc", {"cell_m", "cbc_time_by_bbb_time"});
  table.row(outcome.contests.fine.cell_m(), outcome.fine_time_ratio);
  table.row(outcome.contests.coarse.cell_m(), outcome.coarse_time_ratio);
  return table;
}

}  // namespace

Tables many_core(const Input& input) {
  const DriveOutcome outcome = contest_on_drive(input);
  return {operations(outcome.contests), differences(outcome.contests), times(outcome)};
}

}  // namespace iog::lab
