#include "lab/experiments/perception/street.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace iog::lab {
namespace {

std::int32_t cell_of(double metres) {
  return static_cast<std::int32_t>(std::floor(metres / kWindowCellM));
}

// Cells of the local frame whose centres lie in one of the outlines.
std::vector<geometry::Cell> cells_in(const std::vector<tools::Solid>& outlines,
                                     const LocalToWorld& to_world) {
  constexpr double kSlackM = 1;  // by which the local frame may be off
  std::set<std::pair<std::int32_t, std::int32_t>> places;
  for (const tools::Solid& outline : outlines) {
    const double reach = outline.half_length + outline.half_width + kSlackM;
    for (std::int32_t y = cell_of(outline.at.y - reach); y <= cell_of(outline.at.y + reach); ++y) {
      for (std::int32_t x = cell_of(outline.at.x - reach); x <= cell_of(outline.at.x + reach);
           ++x) {
        const LocalToWorld::Point at = to_world.centre_of({x, y});
        if (covers(outline, at.x_m, at.y_m)) {
          places.emplace(x, y);
        }
      }
    }
  }
  std::vector<geometry::Cell> cells(places.size());
  std::ranges::transform(places, cells.begin(), [](const auto& place) {
    return geometry::Cell{place.first, place.second};
  });
  return cells;
}

}  // namespace

void StreetWatch::add(const PerceivedFrame& frame, const FrameTruth& truth) {
  const double time_s = static_cast<double>(frame.drive->frame_end_us(frame.number)) / 1e6;
  follow_states(time_s, truth.last().things);
  add_hits(time_s, frame, truth);
  watch_left(time_s, frame, truth);
  for (const auto& [thing, state] : truth.last().things.states()) {
    if (thing >= tools::kFirstMover && state == TrueState::kStanding && stood_on_[thing].empty()) {
      stood_on_[thing] = cells_in(truth.last().things.outlines_of(thing), truth.last().to_world);
    }
  }
}

void StreetWatch::follow_states(double time_s, const TrueThings& things) {
  for (const auto& [thing, state] : things.states()) {
    if (thing < tools::kFirstMover) {
      continue;
    }
    Follow& known = things_[thing];
    if (moves(known.state) && state == TrueState::kSettling) {
      stops_.push_back(
          {.thing = thing, .is_car = known.state == TrueState::kMovingCar, .stopped_s = time_s});
      known.stop = stops_.size();
    }
    if (moves(state)) {
      known.stop = 0;
      if (known.state == TrueState::kStanding) {
        leave(thing);
      }
      stood_on_[thing].clear();
    }
    known.state = state;
  }
}

void StreetWatch::add_hits(double time_s, const PerceivedFrame& frame, const FrameTruth& truth) {
  std::map<std::size_t, SaidCounts> of_frame;  // by stop
  for (const HitCell& hit : frame.hits) {
    const TrueThing near = truth.near(hit);
    const auto known = things_.find(near.thing);
    if (known != things_.end() && known->second.stop > 0 && !moves(near.state)) {
      of_frame[known->second.stop - 1].add(
          said_by(frame.classes.front()[frame.window.place_of(hit.cell)]));
    }
  }
  for (const auto& [number, counts] : of_frame) {
    Stop& stop = stops_[number];
    const double since_s = time_s - stop.stopped_s;
    stop.by_half_second[std::min(static_cast<std::size_t>(since_s * 2), Stop::kHalfSeconds - 1)] +=
        counts;
    stop.frames.push_back({since_s, counts.all(), counts.standing});
  }
}

void StreetWatch::leave(std::uint32_t thing) {
  for (const geometry::Cell& cell : stood_on_[thing]) {
    watched_.emplace_back(cell, left_.size());
    left_.push_back({.thing = thing});
  }
}

void StreetWatch::watch_left(double time_s, const PerceivedFrame& frame, const FrameTruth& truth) {
  std::erase_if(watched_, [&](const std::pair<geometry::Cell, std::size_t>& watched) {
    const auto& [cell, number] = watched;
    LeftCell& left = left_[number];
    if (!frame.window.contains(cell)) {
      return true;
    }
    const LocalToWorld::Point at = truth.last().to_world.centre_of(cell);
    if (truth.last().things.near(at.x_m, at.y_m).state != TrueState::kNothing) {
      return left.seen_s >= 0;  // covered again, or not yet uncovered
    }
    const std::size_t place = frame.window.place_of(cell);
    if (left.seen_s < 0 && frame.evidence[place] < 0) {
      left.seen_s = time_s;
    }
    const Said said = said_by(frame.classes.front()[place]);
    if (left.seen_s >= 0 && left.cleared_s < 0 && !is_occupied(said)) {
      left.cleared_s = time_s - left.seen_s;
    }
    if (left.seen_s >= 0 && said == Said::kFree) {
      left.free_s = time_s - left.seen_s;
    }
    return left.free_s >= 0;
  });
}

}  // namespace iog::lab
