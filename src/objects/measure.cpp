#include "objects/measure.hpp"

#include <algorithm>

#include "numeric/magnitude.hpp"
#include "numeric/square_root.hpp"
#include "objects/claim_gate.hpp"
#include "objects/edges.hpp"
#include "objects/heading.hpp"

namespace iog::objects {
namespace {

enum class Reference : std::uint8_t { kLow, kHigh, kBoth };

// An innovation of the place along one side, with the edge that it is based on.
struct Measurement {
  Reference by = Reference::kBoth;
  std::int32_t innovation_mm = 0;
  std::int32_t variance = 1;  // mm^2
  bool is_end_hidden = false;
};

constexpr std::int32_t square(std::int32_t value) { return value * value; }

// Measures by a face that looks at the car.
Measurement of_face(const Ends& seen, const Interval& box, Reference face) {
  const Edge& edge = face == Reference::kLow ? seen.low : seen.high;
  const std::int32_t expected = face == Reference::kLow ? box.low : box.high;
  return {.by = face,
          .innovation_mm = edge.mm - expected,
          .variance = square(kFaceMm) + square(kHitMm) / edge.hits};
}

constexpr std::int32_t visible_variance(std::int32_t beams_mm) {
  return square(kEndMm) + square(beams_mm) / 4;
}

// Measures by the end opposite to the face. The face may be elsewhere if it is where the view ends.
Measurement of_far_end(const Ends& seen, const Interval& box, Reference face, std::int32_t gate_mm,
                       std::int32_t beams_mm) {
  const std::int32_t low = seen.low.mm - box.low;
  const std::int32_t high = seen.high.mm - box.high;
  const bool is_high = face == Reference::kLow;
  return {.by = is_high ? Reference::kHigh : Reference::kLow,
          .innovation_mm = is_high ? high : low,
          .variance = visible_variance(beams_mm),
          .is_end_hidden = numeric::magnitude(is_high ? low : high) > gate_mm};
}

// Measures a side that is seen from beside: by both ends, or by the one that is nearer to its
// expected place. The other end may be hidden, or have just come into view.
Measurement of_ends(const Ends& seen, const Interval& box, std::int32_t gate_mm,
                    std::int32_t beams_mm, bool is_young) {
  const std::int32_t low = seen.low.mm - box.low;
  const std::int32_t high = seen.high.mm - box.high;
  const std::int32_t visible = visible_variance(beams_mm);
  if (numeric::magnitude(low) <= gate_mm && numeric::magnitude(high) <= gate_mm) {
    return {.by = Reference::kBoth, .innovation_mm = (low + high) / 2, .variance = visible};
  }
  const bool is_low = numeric::magnitude(low) < numeric::magnitude(high);
  return {.by = is_low ? Reference::kLow : Reference::kHigh,
          .innovation_mm = is_low ? low : high,
          .variance = is_young ? visible : square(kHiddenEndMm),
          .is_end_hidden = !is_young};
}

// Distance of a place outside one side of a box; negative inside.
constexpr std::int32_t out_of(const Interval& side, std::int32_t place) {
  return std::max(side.low - place, place - side.high);
}

// Whether the car is before or behind the box, but far enough beside it to see the whole side with
// the far end. The face is then seen at an angle and may be where the view ends.
bool is_seen_aslant(const Track& track, Side side, Point car) {
  const Box& box = track.box();
  if (side != kAlong || !track.moves() || !track.has_heading() || track.updates < kHiddenFrom) {
    return false;
  }
  const std::int32_t before = out_of(box.sides[kAlong], box.place(car, kAlong));
  const std::int32_t beside = out_of(box.sides[kAcross], box.place(car, kAcross));
  return beside * 4 > before + box.sides[kAlong].length();
}

Measurement measurement_of(const Track& track, Side side, const Ends& seen, Point car) {
  const Box& box = track.box();
  const Interval& its = box.sides[side];
  const std::int32_t from = box.place(car, side);
  const std::int32_t beams = range_mm(car, box.at) / 1000 * kBeamsOfAMetre;
  const std::int32_t deviations = 3 * root_of(track.covariance(side).place());
  if (out_of(its, from) <= kFacingMm) {
    return of_ends(seen, its, deviations + kEndGateMm, beams, track.updates < kHiddenFrom);
  }
  const Reference face = from < its.low ? Reference::kLow : Reference::kHigh;
  if (is_seen_aslant(track, side, car)) {
    const Measurement end = of_far_end(seen, its, face, deviations + kEndGateMm, beams);
    if (numeric::magnitude(end.innovation_mm) <= deviations + kFarGateMm) {
      return end;
    }
  }
  return of_face(seen, its, face);
}

// Moves an edge towards where it is seen: slowly inwards, faster if it was measured, fastest
// outwards.
std::int32_t followed(std::int32_t edge, std::int32_t seen, bool is_measured, bool is_outward) {
  const std::int32_t off = seen - edge;
  return edge + off / (is_measured ? kFollowMeasured : is_outward ? kFollowOutward : kFollowInward);
}

void follow(const Ends& seen, Reference by, std::int32_t moved_mm, bool may_shrink,
            Interval& side) {
  const Interval before = side;
  const std::int32_t low = seen.low.mm - moved_mm;
  const std::int32_t high = seen.high.mm - moved_mm;
  side.low = followed(side.low, low, by == Reference::kLow, low < side.low);
  side.high = followed(side.high, high, by == Reference::kHigh, high > side.high);
  side.high = std::max(side.high, side.low + kThinnestMm);
  if (!may_shrink) {
    side = {std::min(side.low, before.low), std::max(side.high, before.high)};
  }
}

// The largest change of speed along a side by one measurement, mm/s. Tracks that are not moving
// have no limit: their speed may only reflect parts that come into view.
std::int32_t most_change(const Track& track, Step step) {
  const bool has_grip = track.moves() && track.updates >= kGripFrom;
  return has_grip ? kGrip / 1000 * step.ms() : kMostSpeed;
}

void measure(Point car, Side side, const Ends& seen, Step step, Track& track) {
  Measurement its = measurement_of(track, side, seen, car);
  Covariance& covariance = track.covariance(side);
  if (track.updates >= kCutFrom) {
    const auto sum = static_cast<std::uint64_t>(std::int64_t{covariance.place()} + its.variance);
    const auto most = 3 * static_cast<std::int32_t>(numeric::square_root(sum)) + kCutMm;
    its.innovation_mm = std::clamp(its.innovation_mm, -most, most);
  }
  track.seen.is_end_hidden = track.seen.is_end_hidden || its.is_end_hidden;
  const Covariance::Gain gain = covariance.measure(its.variance);
  track.correct(side, gain, its.innovation_mm, most_change(track, step));
  const std::int64_t moved_mm = std::int64_t{gain.place} * its.innovation_mm >> 16;
  // Standing hits may be its other side, so the box keeps an ordinary width.
  const bool may_shrink = track.seen.standing == 0 || !track.is_sure_car() ||
                          track.sides()[side].length() > kOrdinaryWidthMm;
  follow(seen, its.by, static_cast<std::int32_t>(moved_mm), may_shrink, track.sides()[side]);
}

// Gives up all standing hits. Not used for a walker in front of a pole, who may have no other hits.
void leave_standing(std::span<const std::uint16_t> numbers, std::span<FrameHit> hits) {
  for (const std::uint16_t number : numbers) {
    if (hits[number].stands) {
      hits[number].owner = kNobody;
    }
  }
}

// The edge of the face that looks at the car, including standing hits. The grid calls the rear of a
// slowly receding object standing, because it covered each place for long. Only standing hits
// within the width of the box count, so things beside the object do not widen it. If the object
// does stand, these hits hold the face in place.
Edge face_with_standing(Side side, Reference face, std::span<const std::uint16_t> numbers,
                        std::span<const FrameHit> hits, const Edge& edge, const Box& box) {
  const Side other = side == kAlong ? kAcross : kAlong;
  const std::int32_t outwards = face == Reference::kLow ? 1 : -1;
  const auto for_each_place = [&](auto&& visit) {
    for (const std::uint16_t number : numbers) {
      const Point at = hits[number].moved;
      const std::int32_t beside = box.place(at, other);
      if (!hits[number].stands ||
          (beside >= box.sides[other].low && beside <= box.sides[other].high)) {
        visit(outwards * box.place(at, side));
      }
    }
  };
  std::int32_t outermost = outwards * edge.mm;
  for_each_place([&](std::int32_t place) { outermost = std::min(outermost, place); });
  std::int32_t sum = 0;
  std::int32_t count = 0;
  for_each_place([&](std::int32_t place) {
    const bool is_near = place - outermost <= kSlabMm;
    sum += is_near ? place - outermost : 0;
    count += is_near ? 1 : 0;
  });
  const std::int32_t counted = std::max<std::int32_t>(count, 1);
  return {.mm = outwards * (outermost + sum / counted), .hits = counted};
}

void take_standing_faces(Point car, std::span<const std::uint16_t> numbers,
                         std::span<const FrameHit> hits, const Box& box, Edges& edges) {
  for (const Side side : kSides) {
    const std::int32_t from = box.place(car, side);
    if (out_of(box.sides[side], from) > kFacingMm) {
      const bool is_low = from < box.sides[side].low;
      Edge& edge = is_low ? edges[side].low : edges[side].high;
      edge = face_with_standing(side, is_low ? Reference::kLow : Reference::kHigh, numbers, hits,
                                edge, box);
    }
  }
}

// Includes standing hits within the width of a definite car (docs/objects.md) in both of its ends,
// because most of a long side covers the same places for long.
void take_standing_ends(std::span<const std::uint16_t> numbers, std::span<const FrameHit> hits,
                        const Box& box, Ends& ends) {
  ends.low = face_with_standing(kAlong, Reference::kLow, numbers, hits, ends.low, box);
  ends.high = face_with_standing(kAlong, Reference::kHigh, numbers, hits, ends.high, box);
}

}  // namespace

void measure(Point car, std::uint64_t now_us, Step step, std::span<const std::uint16_t> numbers,
             std::span<FrameHit> hits, Track& track) {
  for (const std::uint16_t number : numbers) {
    const FrameHit& hit = hits[number];
    track.seen.standing += hit.stands ? 1 : 0;
    track.seen.hits += hit.stands ? 0 : 1;
    track.seen.moving += !hit.stands && hit.name == Name::kMoving ? 1 : 0;
  }
  if (track.seen.hits == 0) {  // unseen; the standing hits belong to something parked
    if (longest_of(track.box().sides) >= kSmallMm || track.has_trail()) {
      leave_standing(numbers, hits);
    }
    return;
  }
  Edges edges = edges_of(track.box(), numbers, hits);
  if (track.seen.standing > 0 && track.may_have_a_standing_face()) {
    take_standing_faces(car, numbers, hits, track.box(), edges);
  }
  if (track.seen.standing > 0 && track.is_sure_car()) {
    take_standing_ends(numbers, hits, track.box(), edges[kAlong]);
  }
  for (const Side side : kSides) {
    measure(car, side, edges[side], step, track);
  }
  track.seen_us = now_us;
  ++track.updates;
  turn(numbers, hits, track);
  if (track.is_mostly_standing()) {
    leave_standing(numbers, hits);
  }
}

}  // namespace iog::objects
