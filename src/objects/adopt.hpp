// Assigns clusters to tracks.
#pragma once

#include <span>

#include "objects/clusters.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Attaches clusters to nearby tracks. A cluster is attached to the nearest track whose box can grow
// to include the cluster. Attached clusters are assumed to be previously hidden parts of the
// object. Only tracks that are old enough to claim hits are considered.
void attach(Point car, std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// Associates clusters with tracks that are too young to claim hits. Each of these tracks gets the
// cluster whose edges are nearest to the track's edges.
void associate(std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// Assigns all hits of a cluster to a track.
void own(const Track& track, std::size_t slot, std::size_t cluster, Clusters& clusters,
         std::span<FrameHit> hits);

}  // namespace iog::objects
