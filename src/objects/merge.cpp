#include "objects/merge.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "numeric/magnitude.hpp"
#include "objects/strips.hpp"

namespace iog::objects {
namespace {

bool may_merge(const Track& track) { return track.is_there() && track.updates >= kMergeFrom; }

// A corner of the younger box may be kMergeMm outside both sides of the older one. Then it is at
// most 3/2 kMergeMm outside its bounds.
constexpr std::int32_t kMergeReach = kMergeMm * 3 / 2;

// The next track from `from` on that is younger than the first and near to it; count() if there is
// none.
std::size_t next_near(std::span<const Track> tracks, const PlacedTracks& all, std::size_t first,
                      std::size_t from) {
  const auto is_one = [&](std::size_t number) {
    return all.bounds(first).is_near(all.bounds(number), kMergeReach) &&
           tracks[all.slot(number)].id > tracks[all.slot(first)].id;
  };
  std::size_t second = all.next(all.strips(first), from);
  while (second < all.count() && !is_one(second)) {
    second = all.next(all.strips(first), second + 1);
  }
  return second;
}

// The largest difference of speed along an axis. It is larger for two moving cars: a side and a
// face of one car are often seen apart, and one of them is then measured wrong. Two cars that touch
// and drive apart touch only for a moment.
std::int32_t most_apart(const Track& older, const Track& other) {
  const bool are_cars = older.moves() && other.moves() &&
                        longest_of(older.box().sides) >= kSmallMm &&
                        longest_of(other.box().sides) >= kSmallMm;
  return are_cars ? kMergeMovingSpeed : kMergeSpeed;
}

// Whether both are one object. `together` receives the sides that the older box would have.
bool are_one(const Track& older, const Track& other, Sides& together) {
  const Box& box = older.box();
  const Point at = other.box().at;
  const Velocity a = older.velocity();
  const Velocity b = other.velocity();
  const std::int32_t most = most_apart(older, other);
  if (numeric::magnitude(box.at.x_mm - at.x_mm) > kMergeReachMm ||
      numeric::magnitude(box.at.y_mm - at.y_mm) > kMergeReachMm ||
      numeric::magnitude(a.x - b.x) > most || numeric::magnitude(a.y - b.y) > most) {
    return false;
  }
  // A stationary track does not become a part of a moving one.
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
  older.seen.has_merged = true;
  older.confidence = std::max(older.confidence, other.confidence);
  other.end();
}

}  // namespace

void merge(std::span<Track> tracks, std::span<FrameHit> hits) {
  std::array<std::int16_t, kMostTracks> now_of{};  // by slot: the slot that now owns its hits
  for (std::size_t slot = 0; slot < tracks.size(); ++slot) {
    now_of[slot] = static_cast<std::int16_t>(slot);
  }
  bool is_any = false;
  PlacedTracks all(tracks, kMergeReach / 2,
                   may_merge);  // each side of a pair takes half of the reach
  for (std::size_t first = 0; first < all.count(); ++first) {
    const std::uint8_t slot = all.slot(first);
    for (std::size_t second = next_near(tracks, all, first, 0);
         second < all.count() && tracks[slot].is_there();
         second = next_near(tracks, all, first, second + 1)) {
      const std::uint8_t other = all.slot(second);
      Sides together{};
      if (tracks[other].is_there() && are_one(tracks[slot], tracks[other], together)) {
        take_over(tracks[slot], tracks[other], together);
        all.place(first, tracks[slot]);
        std::ranges::replace(now_of, std::int16_t{other}, std::int16_t{slot});
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
