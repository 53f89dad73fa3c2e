#include "objects/adopt.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "numeric/magnitude.hpp"
#include "objects/claim.hpp"
#include "objects/claim_gate.hpp"
#include "objects/strips.hpp"

namespace iog::objects {
namespace {

constexpr std::int32_t kNowhere = std::numeric_limits<std::int32_t>::max();

// The distance before and behind a moving track in which no other object drives. A part that is
// seen there belongs to the track, even if the part between is hidden.
std::int32_t headway_mm(const Track& track) {
  return track.moves() && track.has_heading() ? track.speed() / 1000 * kHeadwayMs : 0;
}

// Distance of a cluster outside the box, on the axis on which it is farther out. The headway along
// the track does not count. kNowhere if the track may not grow by the cluster.
std::int32_t distance_of(const Track& track, const Cluster& cluster) {
  const Box& box = track.box();
  Sides together = box.sides;
  std::array<std::int32_t, 2> apart{};
  for (const Side side : kSides) {
    const std::int32_t first = box.place(cluster.bounds.corner(0), side);
    Interval its{first, first};
    for (unsigned number = 1; number < 4; ++number) {
      its.include(box.place(cluster.bounds.corner(number), side));
    }
    apart[side] = std::max(its.low - box.sides[side].high, box.sides[side].low - its.high);
    together[side].include(its.low);
    together[side].include(its.high);
  }
  const std::int32_t nearest =
      std::max<std::int32_t>(std::max(apart[kAlong] - headway_mm(track), apart[kAcross]), 0);
  const std::int32_t along = together[kAlong].length();
  const std::int32_t across = together[kAcross].length();
  const std::int32_t longer = along - box.sides[kAlong].length();
  const std::int32_t wider = across - box.sides[kAcross].length();
  bool fits = std::max(along, across) <= kLongestMm && std::min(along, across) <= kWidestMm;
  if (track.has_heading()) {
    fits = fits && across <= kWidestMm && longer <= kGrowthAlongMm && wider <= kGrowthAcrossMm &&
           (!track.is_receding || across <= kWidestCarMm || wider <= 0);
  } else if (track.is_receding) {
    fits = fits && std::max(longer, wider) <= kRecedingGrowthMm;
  }
  return fits ? nearest : kNowhere;
}

bool may_grow(const Track& track) { return track.is_there() && track.updates >= kClaimsFrom; }

// Returns a slot; kMostTracks if there is none.
std::size_t nearest_to(const Cluster& cluster, std::int32_t reach_mm, std::span<const Track> tracks,
                       const PlacedTracks& growing) {
  std::size_t nearest = kMostTracks;
  std::int32_t least = reach_mm + 1;
  const std::int32_t near_mm = reach_mm * 3 / 2;
  const Strips strips = Strips::of(cluster.bounds, near_mm);
  std::size_t asked = 0;
  for (std::size_t i = growing.next(strips, 0); i < growing.count() && asked < kMostAsked;
       i = growing.next(strips, i + 1)) {
    if (growing.bounds(i).is_near(cluster.bounds, near_mm)) {
      ++asked;
      const std::uint8_t slot = growing.slot(i);
      const std::int32_t distance = distance_of(tracks[slot], cluster);
      if (distance < least) {
        least = distance;
        nearest = slot;
      }
    }
  }
  return nearest;
}

// Distance between the edges of a cluster and of a track along one axis. Edges are compared instead
// of centres, because one end may be hidden.
std::int32_t edge_gap(Interval cluster, std::int32_t from, Interval track) {
  const std::int32_t low = numeric::magnitude(cluster.low - from - track.low);
  const std::int32_t high = numeric::magnitude(cluster.high - from - track.high);
  return std::min(low, high) + std::max(low, high) / 4;
}

std::int32_t cost_of(const Track& track, const Cluster& cluster) {
  const Box& box = track.box();
  const Bounds& its = cluster.bounds;
  return edge_gap({its.low.x_mm, its.high.x_mm}, box.at.x_mm, box.sides[kAlong]) +
         edge_gap({its.low.y_mm, its.high.y_mm}, box.at.y_mm, box.sides[kAcross]);
}

}  // namespace

void attach(Point car, std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits) {
  PlacedTracks growing(tracks, 0, may_grow);
  for (std::size_t i = 0; i < growing.count(); ++i) {
    const Track& track = tracks[growing.slot(i)];
    if (const std::int32_t headway = headway_mm(track); headway > 0) {
      growing.place(i, track, headway);
    }
  }
  const std::span<Cluster> all = clusters.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::int32_t reach = gap_mm(car, all[i].bounds.low) + kAttachMm;
    const std::size_t slot = nearest_to(all[i], reach, tracks, growing);
    if (slot < tracks.size() &&
        (tracks[slot].moves() || all[i].hits <= tracks[slot].updates + kSmallCluster)) {
      own(tracks[slot], slot, i, clusters, hits);
    }
  }
}

void associate(std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits) {
  const std::span<Cluster> all = clusters.all();
  for (std::size_t slot = 0; slot < tracks.size(); ++slot) {
    const Track& track = tracks[slot];
    if (!track.is_there() || track.updates >= kClaimsFrom) {
      continue;
    }
    std::size_t nearest = all.size();
    std::int32_t least =
        kAssociateMm + kAssociateDeviations * root_of(track.covariance(kAlong).place()) + 1;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].owner != kNobody) {
        continue;
      }
      if (const std::int32_t cost = cost_of(track, all[i]); cost < least) {
        least = cost;
        nearest = i;
      }
    }
    if (nearest < all.size()) {
      own(track, slot, nearest, clusters, hits);
    }
  }
}

void own(const Track& track, std::size_t slot, std::size_t cluster, Clusters& clusters,
         std::span<FrameHit> hits) {
  clusters.all()[cluster].owner = static_cast<std::int16_t>(slot);
  for (const std::uint16_t number : clusters.hits_of(cluster)) {
    own(track, slot, hits[number]);
  }
}

}  // namespace iog::objects
