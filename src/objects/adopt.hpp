// Clusters become parts of tracks.
#pragma once

#include <span>

#include "objects/clusters.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// A cluster beside the box of a track is a part of it that was not seen before: of the tracks that
// take hits, the nearest one that may grow by it.
void attach(Point car, std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// A track that takes no hits by itself yet takes the cluster whose edges lie nearest to its own.
void associate(std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// The hits of a cluster become the track's.
void own(const Track& track, std::size_t slot, std::size_t cluster, Clusters& clusters,
         std::span<FrameHit> hits);

}  // namespace iog::objects
