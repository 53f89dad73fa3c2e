// Assigns clusters to tracks.
#pragma once

#include <span>

#include "objects/clusters.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Assigns each cluster beside a box to the nearest track that may grow by it: the cluster is a part
// of the object that was hidden before. Only tracks that take hits are considered.
void attach(Point car, std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// Assigns to each track that is too young to take hits the cluster whose edges are nearest to its
// own.
void associate(std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// Assigns all hits of a cluster to a track.
void own(const Track& track, std::size_t slot, std::size_t cluster, Clusters& clusters,
         std::span<FrameHit> hits);

}  // namespace iog::objects
