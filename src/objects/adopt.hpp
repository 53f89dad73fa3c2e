// Assigns clusters to tracks.
#pragma once

#include <span>

#include "objects/clusters.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Assigns each cluster next to a box to the nearest track whose box may grow to include the
// cluster. The cluster is a part of the object that was hidden before. Only tracks that may take
// hits are considered.
void attach(Point car, std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// Associates clusters with the tracks that are too young to take hits. Each of these tracks gets
// the cluster whose edges are nearest to the edges of the track.
void associate(std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// Assigns all hits of a cluster to a track.
void own(const Track& track, std::size_t slot, std::size_t cluster, Clusters& clusters,
         std::span<FrameHit> hits);

}  // namespace iog::objects
