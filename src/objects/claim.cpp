#include "objects/claim.hpp"

#include <limits>

#include "objects/recent_hits.hpp"

namespace iog::objects {
namespace {

// Whether something was at this place before the track can have been there. A part of the track
// would have moved on with it since then, but the box does not reach that far. Does not count if a
// receding track hides the place where that part would be now.
bool is_contradicted(const Track& track, const ClaimGate& gate, Point car, Point place,
                     const FrameHit& hit) {
  if (hit.oldest_epoch < kContradictingEpochs || track.updates < kContradictedFrom) {
    return false;
  }
  const bool is_older = hit.stands && hit.oldest_epoch == RecentHits::kEpochs - 1;
  const std::int32_t ms = is_older ? kStandingAgeMs : hit.oldest_epoch * kEpochMs - kEpochSlackMs;
  const std::int32_t slack = kContradictionMm + gate.speed_deviation * ms / 1000;
  const Point now = moved(place, track.velocity(), ms);
  return track.box().outside(now) > slack &&
         !(track.is_receding && track.box().is_between(car, now));
}

}  // namespace

std::uint32_t Claim::begin(const window::Area& area, std::span<const Track> tracks) {
  for (std::size_t slot = 0; slot < tracks.size(); ++slot) {
    if (tracks[slot].is_there()) {
      gates_[slot] = claim_gate_of(tracks[slot]);
    }
  }
  return near_.list(tracks, gates_, area);
}

template <typename Contradict>
std::int16_t Claim::owner_of(Point car, std::span<const Track> tracks, const FrameHit& hit,
                             Contradict&& contradict) const {
  std::int32_t nearest = std::numeric_limits<std::int32_t>::max();
  std::int16_t owner = kNobody;
  for (const std::uint8_t slot : near_.near(hit.cell)) {
    const Track& track = tracks[slot];
    if (!near_.may_take(slot, hit.at()) ||
        (hit.stands && !track.moves() && !track.may_have_a_standing_face())) {
      continue;
    }
    const Point place = moved(hit.at(), track.velocity(), hit.age_ms);
    const std::int32_t outside = track.box().outside(place);
    const std::int32_t gate = hit.stands ? kGateStandingMm : gates_[slot].mm;
    if (outside > gate || outside >= nearest) {
      continue;
    }
    if (is_contradicted(track, gates_[slot], car, place, hit)) {
      contradict(slot);
      continue;
    }
    nearest = outside;
    owner = slot;
  }
  return owner;
}

void Claim::take(Point car, std::span<const Track> tracks, FrameHit& hit) const {
  hit.contradicted = 0;
  const std::int16_t owner = owner_of(car, tracks, hit, [&](std::uint8_t slot) {
    hit.contradicted_track = hit.contradicted == 0 ? slot : hit.contradicted_track;
    ++hit.contradicted;
  });
  if (owner != kNobody) {
    const auto slot = static_cast<std::size_t>(owner);
    own(tracks[slot], slot, hit);
  }
}

void Claim::count_contradictions(Point car, std::span<Track> tracks,
                                 std::span<const FrameHit> hits) const {
  for (const FrameHit& hit : hits) {
    const auto count = [&](std::uint8_t slot) { ++tracks[slot].seen.contradicted; };
    if (hit.contradicted == 1) {
      count(hit.contradicted_track);
    } else if (hit.contradicted > 1) {
      static_cast<void>(owner_of(car, tracks, hit, count));
    }
  }
}

void own(const Track& track, std::size_t slot, FrameHit& hit) {
  hit.owner = static_cast<std::int16_t>(slot);
  hit.moved = moved(hit.at(), track.velocity(), hit.age_ms);
}

}  // namespace iog::objects
