#include "lab/experiments/perception/street.hpp"

#include <algorithm>

namespace iog::lab {
void StreetWatch::add(const PerceivedFrame& frame, const FrameTruth& truth) {
  const double time_s = static_cast<double>(frame.drive->frame_end_us(frame.number)) / 1e6;
  follow_states(time_s, truth.last().things);
  add_hits(time_s, frame, truth);
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

}  // namespace iog::lab
