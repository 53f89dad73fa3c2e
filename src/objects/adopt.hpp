// Assigns clusters to tracks.
#pragma once

#include <span>

#include "objects/clusters.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// If a cluster lies next to the box of a track, attaches the cluster to the nearest track whose box
// can grow to include it. Such a cluster is a previously hidden part of the object. Only tracks
// that are old enough to claim hits are considered.
void attach(Point car, std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// Associates clusters with tracks that are too young to claim hits. Each of these tracks gets the
// cluster whose edges are nearest to the track's edges.
void associate(std::span<Track> tracks, Clusters& clusters, std::span<FrameHit> hits);

// Assigns all hits of a cluster to a track.
void own(const Track& track, std::size_t slot, std::size_t cluster, Clusters& clusters,
         std::span<FrameHit> hits);

}  // namespace iog::objects
