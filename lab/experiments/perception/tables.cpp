#include "lab/experiments/perception/tables.hpp"

#include <array>

#include "tools/simulate/scanners/lux_burst.hpp"

namespace iog::lab {
namespace {

constexpr std::uint32_t kFirstScored = tools::kLuxFramesPerSecond;
constexpr std::uint32_t kScoredEvery = 5;
constexpr std::array<std::string_view, kHitOnCount> kHitOnNames{"standing", "moving_car",
                                                                "followed_car", "moving_person"};

}  // namespace

ScoredDrive score_drive(const PerceivedDrive& drive, std::span<const PerceptionRule> rules,
                        bool is_watched) {
  ScoredDrive scored{.scorer = PerceptionScorer(rules.size(), kFirstScored)};
  PerceivedDrive shown = drive;
  shown.shown_every = is_watched ? 1 : kScoredEvery;
  LocalToWorld to_world;
  perceive_drive(shown, rules, [&](const PerceivedFrame& frame) {
    const FrameTruth truth(frame, to_world);
    to_world = truth.last().to_world;
    scored.scorer.add(frame, truth, frame.number % kScoredEvery == kScoredEvery - 1);
    if (is_watched) {
      scored.watch.add(frame, truth);
    }
    scored.frames_not_placed += frame.end->slice_count == 0 ? 1U : 0U;
    scored.frames_forgotten += frame.engine->is_forgotten() ? 1U : 0U;
    scored.packets_not_placed += frame.end->packets_not_placed;
    scored.last = *frame.end;
  });
  return scored;
}

ScoreTables::ScoreTables(const std::string& name)
    : hits(name + "_hits",
           {"scene", "seed", "poses", "rule", "hits_on", "range_from_m", "unknown_cells",
            "free_cells", "moving_cells", "standing_cells", "open_cells"}),
      moving(name + "_moving",
             {"scene", "seed", "poses", "rule", "called_cells", "right_cells", "left_lately_cells",
              "called_with_evidence_cells", "right_with_evidence_cells"}),
      recent(name + "_recent", {"scene", "seed", "poses", "rule", "material", "hit_cells",
                                "kept_cells", "freed_cells"}),
      gaps(name + "_gaps", {"scene", "seed", "poses", "rule", "known_within_cells", "between_cells",
                            "unknown_cells"}) {}

void ScoreTables::add(const PerceivedDrive& drive, std::string_view poses,
                      std::span<const PerceptionRule> rules, const PerceptionScorer& scorer) {
  for (std::size_t rule = 0; rule < rules.size(); ++rule) {
    add_scores(drive, poses, rules[rule].name, scorer.scores()[rule]);
  }
  add_gaps(drive, poses, "single frame", scorer.gaps_of_frames());
}

void ScoreTables::add_scores(const PerceivedDrive& drive, std::string_view poses,
                             std::string_view rule, const PerceptionScores& scores) {
  for (std::size_t what = 0; what < kHitOnCount; ++what) {
    for (std::size_t range = 0; range < kRangeCount; ++range) {
      const SaidCounts& said = scores.hits[what][range];
      hits.row(drive.scene, drive.seed, poses, rule, kHitOnNames[what],
               range == 0 ? 0.0 : kRangesM[range - 1], said.unknown, said.free, said.moving,
               said.standing, said.open);
    }
  }
  const MovingCells& called = scores.moving;
  moving.row(drive.scene, drive.seed, poses, rule, called.called, called.right, called.left_lately,
             called.with_evidence, called.right_with_evidence);
  for (std::size_t material = 0; material < kMaterialNames.size(); ++material) {
    if (scores.recent.cells[material] > 0) {
      recent.row(drive.scene, drive.seed, poses, rule, kMaterialNames[material],
                 scores.recent.cells[material], scores.recent.kept[material],
                 scores.recent.freed[material]);
    }
  }
  add_gaps(drive, poses, rule, scores.gaps);
}

void ScoreTables::add_gaps(const PerceivedDrive& drive, std::string_view poses,
                           std::string_view rule, std::span<const GapCounts> counts) {
  for (std::size_t i = 0; i < counts.size(); ++i) {
    gaps.row(drive.scene, drive.seed, poses, rule, kGapReaches[i], counts[i].between,
             counts[i].unknown);
  }
}

}  // namespace iog::lab
