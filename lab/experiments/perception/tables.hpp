// Drives scored for the perception grid, and the tables of the scores, the same columns for each.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "lab/experiments/experiment.hpp"
#include "lab/experiments/perception/perceived_drive.hpp"
#include "lab/experiments/perception/scores.hpp"
#include "lab/experiments/perception/street.hpp"

namespace iog::lab {

// A drive's scores by rule, what happened in it, and how its poses fared.
struct ScoredDrive {
  PerceptionScorer scorer;
  StreetWatch watch{};
  stream::ClassEnd last{};              // of the last frame; it counts since the drive's begin
  std::uint32_t frames_not_placed = 0;  // without a single slice
  std::uint32_t frames_forgotten = 0;
  std::uint32_t packets_not_placed = 0;
};

// Scores every fifth frame after the first second, in which a window knows little. is_watched: each
// frame is watched for things that stop.
[[nodiscard]] ScoredDrive score_drive(const PerceivedDrive& drive,
                                      std::span<const PerceptionRule> rules, bool is_watched);

// Their names are `name`_hits and so on.
struct ScoreTables {
  explicit ScoreTables(const std::string& name);

  void add(const PerceivedDrive& drive, std::string_view poses,
           std::span<const PerceptionRule> rules, const PerceptionScorer& scorer);

  Table hits;    // by what was hit, and how far away, the cells by what is said of them
  Table moving;  // cells that are called moving
  Table recent;  // cells that were hit lately, by material
  Table gaps;    // cells between known ones

 private:
  void add_scores(const PerceivedDrive& drive, std::string_view poses, std::string_view rule,
                  const PerceptionScores& scores);
  void add_gaps(const PerceivedDrive& drive, std::string_view poses, std::string_view rule,
                std::span<const GapCounts> counts);
};

}  // namespace iog::lab
