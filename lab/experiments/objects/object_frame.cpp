#include "lab/experiments/objects/object_frame.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "numeric/magnitude.hpp"
#include "objects/stated.hpp"

namespace iog::lab {
namespace {

Vector2 in_metres(const LocalToWorld::Point& point) { return {point.x_m, point.y_m}; }

// The slice of a hit, by its age: slices do not end together.
std::uint8_t slice_of(const PerceivedFrame& frame, const objects::FrameHit& hit) {
  const auto slices = frame.engine->slices();
  const auto away_us = [&](const fusion::PlacedSlice& placed) {
    const auto age_us =
        static_cast<std::int64_t>(frame.engine->objects().time_us() - placed.slice.middle_us);
    return numeric::magnitude(age_us - std::int64_t{1000} * hit.age_ms);
  };
  const auto nearest = std::ranges::min_element(slices, {}, away_us);
  return static_cast<std::uint8_t>(nearest - slices.begin());
}

using Counts = std::map<std::int64_t, std::size_t>;  // by thing, or by slot

// The lowest of those that have most.
std::optional<std::int64_t> most_of(const Counts& counts) {
  const auto most = std::ranges::max_element(counts, {}, &Counts::value_type::second);
  return most == counts.end() ? std::nullopt : std::optional(most->first);
}

// The hits of a frame by what they are on and whose they are.
struct HitsByTruth {
  struct OfTrack {
    Counts movers;             // by thing
    std::size_t settling = 0;  // on what has just stopped
    std::size_t others = 0;
    [[nodiscard]] std::size_t on_movers() const {
      std::size_t sum = settling;
      for (const auto& [thing, count] : movers) {
        sum += count;
      }
      return sum;
    }
  };
  struct OfThing {
    std::size_t hits = 0;
    Counts tracks;  // by slot
  };
  std::map<std::int64_t, OfTrack> tracks;   // by slot
  std::map<std::uint32_t, OfThing> things;  // that move, by number

  HitsByTruth(const PerceivedFrame& frame, const FrameTruth& truth,
              const objects::Tracker& tracker) {
    for (const objects::FrameHit& hit : tracker.hits()) {
      add(hit.owner, truth.near({hit.cell, slice_of(frame, hit)}));
    }
  }

 private:
  void add(std::int16_t owner, const TrueThing& on) {
    const bool is_owned = owner != objects::kNobody;
    if (moves(on.state)) {
      OfThing& thing = things[on.thing];
      ++thing.hits;
      if (is_owned) {
        ++thing.tracks[owner];
        ++tracks[owner].movers[on.thing];
      }
    } else if (is_owned) {
      ++(on.state == TrueState::kSettling ? tracks[owner].settling : tracks[owner].others);
    }
  }
};

// Makes the movers first, so that a track is known by what it tells.
class Maker {
 public:
  Maker(const PerceivedFrame& frame, const FrameTruth& truth, const objects::Tracker& tracker)
      : to_world_(&truth.last().to_world),
        tracks_(&tracker.tracks()),
        car_{frame.end->window.pose.x_mm, frame.end->window.pose.y_mm},
        hits_(frame, truth, tracker),
        motions_(truth.last().things.motions()) {
    made_.time_us = frame.engine->objects().time_us();
    for (const auto& [thing, hits] : hits_.things) {
      add_mover(thing, hits);
    }
    for (const auto& [slot, hits] : hits_.tracks) {
      add_track(slot, hits);
    }
  }

  [[nodiscard]] ObjectFrame take() { return std::move(made_); }

 private:
  [[nodiscard]] bool is_near(const Vector2& at) const {
    return distance(at, in_metres(to_world_->car())) <= kCountsM;
  }

  void add_mover(std::uint32_t thing, const HitsByTruth::OfThing& hits) {
    const auto found = motions_.find(thing);
    if (found == motions_.end() || hits.hits < kCountsHits) {
      return;
    }
    const TrueMotion& motion = found->second;
    const Mover mover{.thing = thing,
                      .is_person = motion.is_person,
                      .at = {motion.x_m, motion.y_m},
                      .velocity = {motion.x_mps, motion.y_mps}};
    if (distance(mover.velocity, {}) < kCountsMps || !is_near(mover.at)) {
      return;
    }
    const std::optional<std::int64_t> slot = most_of(hits.tracks);
    if (slot && track(*slot).moves()) {
      tells_[*slot].push_back(made_.movers.size());
    }
    counted_.insert(thing);
    made_.movers.push_back(mover);
  }

  void add_track(std::int64_t slot, const HitsByTruth::OfTrack& hits) {
    const objects::Track& its = track(slot);
    const auto told = tells_.find(slot);
    const Vector2 at = middle_of(its.box());
    if (!its.moves() || (told == tells_.end() && !is_near(at))) {
      return;
    }
    if (told != tells_.end()) {
      for (const std::size_t mover : told->second) {
        made_.movers[mover].told_by = made_.reported.size();
      }
    }
    const objects::Velocity velocity = its.believed_velocity();
    made_.reported.push_back(
        {.id = its.id,
         .at = at,
         .velocity = in_metres(to_world_->turned(velocity.x / 1000.0, velocity.y / 1000.0)),
         .deviation = stated(its),
         .born_us = its.born_us,
         .on = on_of(hits)});
  }

  // m/s
  [[nodiscard]] double stated(const objects::Track& its) const {
    const auto deviation = static_cast<std::uint32_t>(its.speed_deviation());
    return objects::stated_deviation(deviation, its, made_.time_us, car_) / 1000.0;
  }

  [[nodiscard]] ReportedOn on_of(const HitsByTruth::OfTrack& hits) const {
    if (hits.on_movers() == 0 || 2 * hits.on_movers() < hits.others) {
      return ReportedOn::kNothing;
    }
    const std::optional<std::int64_t> thing = most_of(hits.movers);
    return thing && counted_.contains(static_cast<std::uint32_t>(*thing)) ? ReportedOn::kMover
                                                                          : ReportedOn::kIgnored;
  }

  [[nodiscard]] const objects::Track& track(std::int64_t slot) const {
    return (*tracks_)[static_cast<std::size_t>(slot)];
  }

  // Not the point that it turns around.
  [[nodiscard]] Vector2 middle_of(const objects::Box& box) const {
    const objects::Point low = box.corner(0);
    const objects::Point high = box.corner(3);
    return in_metres(
        to_world_->at((low.x_mm + high.x_mm) / 2000.0, (low.y_mm + high.y_mm) / 2000.0));
  }

  const LocalToWorld* to_world_;
  const objects::Tracks* tracks_;
  objects::Point car_;
  HitsByTruth hits_;
  std::map<std::uint32_t, TrueMotion> motions_;
  std::map<std::int64_t, std::vector<std::size_t>> tells_;  // by slot, places in movers
  std::set<std::uint32_t> counted_;
  ObjectFrame made_;
};

}  // namespace

ObjectFrame object_frame(const PerceivedFrame& frame, const FrameTruth& truth,
                         const objects::Tracker& tracker) {
  return Maker(frame, truth, tracker).take();
}

}  // namespace iog::lab
