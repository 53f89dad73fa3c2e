// How good the classes of the perception grid are on simulated drives in which everything moves:
// under the default rule, under the thesis's and others, in front of what stops, and when poses are
// bad.
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "evidence/assignment.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/experiments/perception/tables.hpp"
#include "tools/simulate/scanners/lux_burst.hpp"

namespace iog::lab {
namespace {

constexpr std::string_view kUsualPoses = "usual";

// The default, the grid alone, and the thesis's: every conflict moves, masses are of scans (Kurdej
// 2015, sections 5.2 and 7.3, with the discounting of 6.3.1), which knows no things. Then rules
// that differ from the default in one choice.
constexpr std::array kPerceptionRules{
    PerceptionRule{"default"},
    PerceptionRule{.name = "grid alone", .has_objects = false},
    PerceptionRule{
        .name = "thesis",
        .rules = {.weighing = ageing::Weighing::kEachScan, .moved = perception::Moved::kLiteral},
        .has_objects = false},
    PerceptionRule{"optimistic", {.discounting = ageing::Discounting::kOptimistic}},
    PerceptionRule{"every conflict moves", {.moved = perception::Moved::kLiteral}},
    PerceptionRule{"masses of scans", {.weighing = ageing::Weighing::kEachScan}},
    PerceptionRule{"reinforced", {.assignment = &evidence::kReinforced}},
    PerceptionRule{"isopignistic", {.assignment = &evidence::kIsopignistic}},
    PerceptionRule{"classical", {.discounting = ageing::Discounting::kClassical}},
    PerceptionRule{"proportional", {.discounting = ageing::Discounting::kProportional}},
    PerceptionRule{.name = "opened from below", .moved = {.low_mm = 800, .tall_mm = 0}},
};

// What happens to the poses, from kTroubleS on if it has a time.
constexpr double kTroubleS = 3;
constexpr std::uint32_t kTroubleSeconds = 6;

struct PoseTrouble {
  std::string_view name;
  tools::PoseOptions poses;
};

std::vector<PoseTrouble> pose_troubles() {
  const auto with = [](auto&& change) {
    tools::PoseOptions options;
    change(options);
    return options;
  };
  return {
      {kUsualPoses, {}},
      {"sigma of 5 cm", with([](auto& options) { options.sigma_m = 0.05; })},
      {"sigma of 20 cm", with([](auto& options) { options.sigma_m = 0.2; })},
      {"jump of 0.25 m", with([](auto& options) {
         options.jumps = {{kTroubleS, 0.25}};
       })},
      {"jump of 0.5 m", with([](auto& options) {
         options.jumps = {{kTroubleS, 0.5}};
       })},
      {"swing of 0.28 m in 2 s", with([](auto& options) {
         options.swings = {{kTroubleS, 0.28, 2}};
       })},
      {"swing of 0.7 m in 8 s", with([](auto& options) {
         options.swings = {{kTroubleS, 0.7, 8}};
       })},
      {"gap of 0.5 s", with([](auto& options) {
         options.gaps = {{kTroubleS, 0.5}};
       })},
      {"gap of 1.5 s", with([](auto& options) {
         options.gaps = {{kTroubleS, 1.5}};
       })},
      {"restart", with([](auto& options) { options.restarts_s = {kTroubleS}; })},
  };
}

// What can become of these drives: no source of them is stuck.
constexpr std::array<std::string_view, 6> kCauseNames{"none", "late", "imprecise",
                                                      "lost", "jump", "restart"};

// Hits by half seconds since their thing stopped; of cars frame by frame, too.
void add_stops(std::uint64_t seed, const StreetWatch& watch, Table& stops, Table& times) {
  for (const Stop& stop : watch.stops()) {
    const std::string_view what = stop.is_car ? "car" : "person";
    for (std::size_t half = 0; half < Stop::kHalfSeconds; ++half) {
      const SaidCounts& said = stop.by_half_second[half];
      if (said.all() > 0) {
        stops.row(seed, stop.thing, what, 0.5 * static_cast<double>(half), said.unknown, said.free,
                  said.moving, said.standing, said.open);
      }
    }
    for (const StopFrame& frame : stop.frames) {
      if (stop.is_car) {
        times.row(seed, stop.thing, frame.since_s, frame.cells, frame.standing);
      }
    }
  }
}

}  // namespace

// The first three rules on all drives, the others on the first.
Tables perception_rules(const Input& /*input*/) {
  ScoreTables tables("perception");
  for (const std::string_view scene : {"city", "ring_road"}) {
    for (const std::uint64_t seed : kCleanSeeds) {
      const std::span all(kPerceptionRules);
      const bool is_first = seed == kCleanSeeds.front();
      const auto rules = !is_first ? all.first(3) : scene == "city" ? all : all.first(4);
      const PerceivedDrive drive{.scene = scene, .seed = seed, .seconds = kRoadSeconds};
      tables.add(drive, kUsualPoses, rules, score_drive(drive, rules, false).scorer);
    }
  }
  return {std::move(tables.hits), std::move(tables.moving), std::move(tables.recent),
          std::move(tables.gaps)};
}

Tables perception_street(const Input& /*input*/) {
  ScoreTables tables("perception_street");
  Table stops("perception_stops", {"seed", "thing", "what", "from_s", "unknown_cells", "free_cells",
                                   "moving_cells", "standing_cells", "open_cells"});
  Table times("perception_stop_frames",
              {"seed", "thing", "since_s", "hit_cells", "standing_cells"});
  const auto rules = std::span(kPerceptionRules).first(2);
  for (const std::uint64_t seed : kCleanSeeds) {
    const PerceivedDrive drive{.scene = "street", .seed = seed, .seconds = kStreetSeconds};
    const ScoredDrive scored = score_drive(drive, rules, true);
    tables.add(drive, kUsualPoses, rules, scored.scorer);
    add_stops(seed, scored.watch, stops, times);
  }
  return {std::move(tables.hits), std::move(tables.moving), std::move(stops), std::move(times)};
}

Tables perception_poses(const Input& /*input*/) {
  ScoreTables tables("perception_poses");
  Table causes("perception_poses_causes", {"poses", "cause", "times", "slices"});
  Table frames("perception_poses_frames",
               {"poses", "frames", "frames_not_placed", "frames_forgotten", "packets_not_placed"});
  const auto rules = std::span(kPerceptionRules).first(2);
  for (const PoseTrouble& trouble : pose_troubles()) {
    const PerceivedDrive drive{.scene = "city",
                               .seed = kCleanSeeds.front(),
                               .seconds = kTroubleSeconds,
                               .poses = trouble.poses};
    const ScoredDrive scored = score_drive(drive, rules, false);
    tables.add(drive, trouble.name, rules, scored.scorer);
    for (std::size_t cause = 1; cause < kCauseNames.size(); ++cause) {
      causes.row(trouble.name, kCauseNames[cause], scored.last.causes[cause].began.times,
                 scored.last.causes[cause].slices);
    }
    frames.row(trouble.name, drive.seconds * tools::kLuxFramesPerSecond, scored.frames_not_placed,
               scored.frames_forgotten, scored.packets_not_placed);
  }
  return {std::move(tables.hits), std::move(tables.moving), std::move(tables.recent),
          std::move(causes), std::move(frames)};
}

}  // namespace iog::lab
