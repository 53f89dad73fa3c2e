// What the classes of a perceived drive are worth, counted frame by frame against the truth.
//
// A hit is a cell with a positive index in a slice of the frame. It is on what is within 0.2 m of
// the cell's centre when the slice was measured (lab/evaluation/true_things.hpp), and counts by
// what the frame's classes say of the cell. A cell that is called moving is right if at the time of
// a slice of the frame something moved within 0.2 m, or had stopped less than a second ago.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "lab/evaluation/perception.hpp"
#include "lab/evaluation/true_things.hpp"
#include "lab/experiments/perception/perceived_drive.hpp"
#include "lab/experiments/perception/truth.hpp"

namespace iog::lab {

// What a hit was on.
enum class HitOn : std::uint8_t {
  kStanding,
  kMovingCar,
  kFollowedCar,  // it drives by the car itself all the time: ahead in its lane, or behind
  kMovingPerson,
};
inline constexpr std::size_t kHitOnCount = 4;

// How far a hit was from the car: nearer than 15 m, than 30 m, or farther.
inline constexpr std::array<double, 2> kRangesM{15, 30};
inline constexpr std::size_t kRangeCount = kRangesM.size() + 1;

// Gaps are counted from 20 m on, with known cells at most so many cells away.
inline constexpr std::array<std::size_t, 2> kGapReaches{2, 5};

struct MovingCells {
  std::uint64_t called = 0;
  std::uint64_t right = 0;
  std::uint64_t left_lately = 0;    // not right, but something moved there in the second before
  std::uint64_t with_evidence = 0;  // of those called: with evidence in that very frame
  std::uint64_t right_with_evidence = 0;
};

struct PerceptionScores {
  std::array<std::array<SaidCounts, kRangeCount>, kHitOnCount> hits{};
  MovingCells moving{};
  RecentHits::Kept recent{};  // hits on what stands, by tools::Material
  std::array<GapCounts, kGapReaches.size()> gaps{};
};

class PerceptionScorer {
 public:
  // Frames before first_scored only fill the memory of hits.
  PerceptionScorer(std::size_t rules, std::uint32_t first_scored)
      : scores_(rules), first_scored_(first_scored) {}

  // Frames one after another. is_scored: the frame's classes are shown, and count.
  void add(const PerceivedFrame& frame, const FrameTruth& truth, bool is_scored);

  // In the order of the rules.
  [[nodiscard]] const std::vector<PerceptionScores>& scores() const { return scores_; }
  // Of the frames' own evidence, for comparison.
  [[nodiscard]] const std::array<GapCounts, kGapReaches.size()>& gaps_of_frames() const {
    return gaps_of_frames_;
  }

 private:
  void score_hits(const PerceivedFrame& frame, const std::vector<TrueThing>& hit_things);
  void score_moving(const PerceivedFrame& frame, const FrameTruth& truth);
  void score_gaps(const PerceivedFrame& frame);
  [[nodiscard]] bool moved_lately(const LocalToWorld::Point& at) const;

  std::vector<PerceptionScores> scores_;
  std::uint32_t first_scored_;
  RecentHits recent_;
  std::deque<TrueThings> lately_;  // of the frames of the last second, the newest in front
  std::array<GapCounts, kGapReaches.size()> gaps_of_frames_{};
};

}  // namespace iog::lab
