#include "objects/merge.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "numeric/magnitude.hpp"

namespace iog::objects {
namespace {

bool may_merge(const Track& track) { return track.is_there() && track.updates >= kMergeFrom; }

// The sides that the older one's box would have; longer than kLongestMm if they are two things.
bool are_one(const Track& older, const Track& other, Sides& together) {
  const Box& box = older.box();
  const Point at = other.box().at;
  const Velocity a = older.velocity();
  const Velocity b = other.velocity();
  if (numeric::magnitude(box.at.x_mm - at.x_mm) > kMergeReachMm ||
      numeric::magnitude(box.at.y_mm - at.y_mm) > kMergeReachMm ||
      numeric::magnitude(a.x - b.x) > kMergeSpeed || numeric::magnitude(a.y - b.y) > kMergeSpeed) {
    return false;
  }
  // What stands does not become a part of what moves.
  if (older.moves() != other.moves() && other.speed() < kMoveSpeed) {
    return false;
  }
  together = box.sides;
  std::int32_t nearest = std::numeric_limits<std::int32_t>::max();
  for (unsigned number = 0; number < 4; ++number) {
    const Point corner = other.box().corner(number);
    nearest = std::min(nearest, box.outside(corner));
    for (const Side side : kSides) {
      together[side].include(box.place(corner, side));
    }
  }
  const std::int32_t along = together[kAlong].length();
  const std::int32_t across = together[kAcross].length();
  return nearest <= kMergeMm && std::max(along, across) <= kLongestMm &&
         std::min(along, across) <= kMergeWidestMm;
}

void take_over(Track& older, Track& other, const Sides& together) {
  older.sides() = together;
  older.seen.hits += other.seen.hits;
  older.seen.moving += other.seen.moving;
  older.confidence = std::max(older.confidence, other.confidence);
  other.end();
}

}  // namespace

void merge(Tracks& tracks, std::span<FrameHit> hits) {
  std::array<std::int16_t, kMostTracks> now_of{};  // by slot, whose its hits are now
  for (std::size_t slot = 0; slot < tracks.size(); ++slot) {
    now_of[slot] = static_cast<std::int16_t>(slot);
  }
  bool is_any = false;
  for (std::size_t slot = 0; slot < tracks.size(); ++slot) {
    for (std::size_t i = 0; i < tracks.size() && may_merge(tracks[slot]); ++i) {
      Track& other = tracks[i];
      Sides together{};
      if (may_merge(other) && other.id > tracks[slot].id &&
          are_one(tracks[slot], other, together)) {
        take_over(tracks[slot], other, together);
        std::ranges::replace(now_of, static_cast<std::int16_t>(i), static_cast<std::int16_t>(slot));
        is_any = true;
      }
    }
  }
  for (FrameHit& hit : hits) {
    if (is_any && hit.owner != kNobody) {
      hit.owner = now_of[static_cast<std::size_t>(hit.owner)];
    }
  }
}

}  // namespace iog::objects
