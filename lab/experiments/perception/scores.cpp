#include "lab/experiments/perception/scores.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tools/simulate/scanners/lux_burst.hpp"
#include "window/area.hpp"

namespace iog::lab {
namespace {

constexpr std::int32_t kFarCells = 200;  // 20 m
constexpr std::size_t kSide = window::kCellsAcross;
constexpr std::size_t kFramesOfASecond = tools::kLuxFramesPerSecond;

// Where the car is, or the middle of its window if nothing of the frame was placed.
geometry::Cell car_cell(const PerceivedFrame& frame) {
  const std::span<const fusion::PlacedSlice> slices = frame.engine->slices();
  constexpr std::int32_t kHalf = window::kCellsAcross / 2;
  return slices.empty() ? geometry::Cell{frame.window.first.x + kHalf, frame.window.first.y + kHalf}
                        : window::cell_of(slices.back().pose);
}

std::size_t range_of(geometry::Cell cell, geometry::Cell car) {
  const double x_m = kWindowCellM * (cell.x - car.x);
  const double y_m = kWindowCellM * (cell.y - car.y);
  const double metres = std::sqrt(x_m * x_m + y_m * y_m);
  return static_cast<std::size_t>(
      std::ranges::count_if(kRangesM, [metres](double edge_m) { return metres >= edge_m; }));
}

HitOn car_of(const PerceivedFrame& frame, std::uint32_t thing) {
  const std::size_t followed = frame.drive->scene().traffic.companions.size();
  return thing < tools::kFirstMover + followed ? HitOn::kFollowedCar : HitOn::kMovingCar;
}

// Empty for what is not scored: nothing, or what has just stopped.
std::optional<HitOn> hit_on(const PerceivedFrame& frame, const TrueThing& thing) {
  switch (thing.state) {
    case TrueState::kStanding:
      return HitOn::kStanding;
    case TrueState::kMovingCar:
      return car_of(frame, thing.thing);
    case TrueState::kMovingPerson:
      return HitOn::kMovingPerson;
    case TrueState::kNothing:
    case TrueState::kSettling:
      break;
  }
  return std::nullopt;
}

}  // namespace

void PerceptionScorer::add(const PerceivedFrame& frame, const FrameTruth& truth, bool is_scored) {
  if (frame.engine->is_forgotten()) {
    recent_.forget();
  }
  std::vector<TrueThing> hit_things;
  std::vector<RecentHits::Hit> standing;
  for (const HitCell& hit : frame.hits) {
    hit_things.push_back(truth.near(hit));
    if (hit_things.back().state == TrueState::kStanding) {
      standing.push_back({hit.cell, static_cast<std::uint8_t>(hit_things.back().material)});
    }
  }
  recent_.add_frame(std::move(standing));
  if (is_scored && frame.number >= first_scored_) {
    score_hits(frame, hit_things);
    score_moving(frame, truth);
    score_gaps(frame);
  }
  lately_.push_front(truth.last().things);
  if (lately_.size() > kFramesOfASecond) {
    lately_.pop_back();
  }
}

void PerceptionScorer::score_hits(const PerceivedFrame& frame,
                                  const std::vector<TrueThing>& hit_things) {
  const geometry::Cell car = car_cell(frame);
  for (std::size_t i = 0; i < hit_things.size(); ++i) {
    const std::optional<HitOn> what = hit_on(frame, hit_things[i]);
    const geometry::Cell cell = frame.hits[i].cell;
    for (std::size_t rule = 0; what && rule < scores_.size(); ++rule) {
      scores_[rule].hits[static_cast<std::size_t>(*what)][range_of(cell, car)].add(
          said_by(frame.classes[rule][frame.window.place_of(cell)]));
    }
  }
  for (std::size_t rule = 0; rule < scores_.size(); ++rule) {
    scores_[rule].recent += recent_.compare(frame.classes[rule], kSide, frame.window.first);
  }
}

void PerceptionScorer::score_moving(const PerceivedFrame& frame, const FrameTruth& truth) {
  for (std::size_t rule = 0; rule < scores_.size(); ++rule) {
    MovingCells& moving = scores_[rule].moving;
    for (std::size_t place = 0; place < frame.evidence.size(); ++place) {
      if (said_by(frame.classes[rule][place]) != Said::kMoving) {
        continue;
      }
      const geometry::Cell cell{frame.window.first.x + static_cast<std::int32_t>(place % kSide),
                                frame.window.first.y + static_cast<std::int32_t>(place / kSide)};
      const bool is_right = truth.is_near_mover(cell);
      const bool has_evidence = frame.evidence[place] != 0;
      ++moving.called;
      moving.right += is_right ? 1U : 0U;
      moving.left_lately +=
          !is_right && moved_lately(truth.last().to_world.centre_of(cell)) ? 1U : 0U;
      moving.with_evidence += has_evidence ? 1U : 0U;
      moving.right_with_evidence += is_right && has_evidence ? 1U : 0U;
    }
  }
}

void PerceptionScorer::score_gaps(const PerceivedFrame& frame) {
  const geometry::Cell car = car_cell(frame);
  const geometry::Cell middle{car.x - frame.window.first.x, car.y - frame.window.first.y};
  for (std::size_t i = 0; i < kGapReaches.size(); ++i) {
    const GapRange range{.reach = kGapReaches[i], .middle = middle, .far_cells = kFarCells};
    gaps_of_frames_[i] += gaps_in(frame.evidence, kSide, range);
    for (std::size_t rule = 0; rule < scores_.size(); ++rule) {
      scores_[rule].gaps[i] += gaps_in(frame.classes[rule], kSide, range);
    }
  }
}

bool PerceptionScorer::moved_lately(const LocalToWorld::Point& at) const {
  return std::ranges::any_of(
      lately_, [&at](const TrueThings& things) { return things.is_near_mover(at.x_m, at.y_m); });
}

}  // namespace iog::lab
