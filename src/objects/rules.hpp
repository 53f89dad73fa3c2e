// Every number of the rules by which hits become things with a speed (docs/objects.md).
//
// Lengths are mm, speeds mm/s, times ms unless a name says otherwise. They are numbers of the rule,
// not of a car.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::objects {

// What is held, and so what a frame can cost. What is beyond is left out, and counted.
inline constexpr std::size_t kMostHits = 4096;
inline constexpr std::size_t kMostTracks = 256;
inline constexpr std::size_t kMostClusters = 256;
inline constexpr std::size_t kMostTracksOfATile = 16;  // that may take hits there
inline constexpr std::size_t kMostAsked = 16;          // tracks that are asked for a cluster

// A longer time between two frames, or none, ends all tracks.
inline constexpr std::int32_t kLongestStepMs = 200;

// Of what was hit lately: epochs of 80 ms.
inline constexpr std::uint64_t kEpochUs = 80'000;
inline constexpr std::int32_t kEpochMs = 80;
inline constexpr int kOldEpochs = 4;  // a place that was hit so long ago is old

// How fast a thing may become: its speed wanders by so many mm/s in a second, times the root of it.
inline constexpr std::int32_t kWanderAlong = 1500;
inline constexpr std::int32_t kWanderAcross = 700;
inline constexpr std::int32_t kWanderAcrossFast = 1200;  // from kWheelsSpeed on, in bends
inline constexpr std::int32_t kWanderSmall = 700;
inline constexpr std::int32_t kSmallMm = 1200;     // a walker is smaller,
inline constexpr std::int32_t kSmallSpeed = 3000;  // and slower
inline constexpr std::int32_t kMostSpeed = 100'000;

// What moves has tyres or legs: from so many updates on its speed along a side changes by so many
// mm/s in a second at most. Brakes and bends have 10 m/s^2.
inline constexpr std::uint32_t kGripFrom = 12;
inline constexpr std::int32_t kGrip = 10'000;

// Which hits a track takes: as far out of its box, and by so many deviations of its place.
inline constexpr std::uint32_t kClaimsFrom = 3;  // updates
inline constexpr std::uint32_t kSettledFrom = 12;
inline constexpr std::int32_t kGateMm = 300;
inline constexpr std::int32_t kGateSettledMm = 250;
inline constexpr std::int32_t kGateStandingMm = 250;
inline constexpr std::int32_t kMostGateDeviationMm = 600;
inline constexpr std::int32_t kMostGateDeviationSettledMm = 300;

// A hit contradicts a track that was elsewhere when something was there before.
inline constexpr std::uint32_t kContradictedFrom = 6;  // updates
inline constexpr int kContradictingEpochs = 3;
inline constexpr std::int32_t kStandingAgeMs = 800;
inline constexpr std::int32_t kEpochSlackMs = 20;
inline constexpr std::int32_t kContradictionMm = 150;

// Hits of one thing are so near to each other.
inline constexpr std::int32_t kGapMm = 400;
inline constexpr std::int32_t kGapOfAMetre = 14;  // more, for each metre of range

// A cluster beside a track is a part of it.
inline constexpr std::int32_t kAttachMm = 300;  // more than the gap
inline constexpr std::int32_t kHeadwayMs = 50;  // nothing follows what moves more closely
inline constexpr std::int32_t kLongestMm = 18'000;
inline constexpr std::int32_t kWidestMm = 3400;
inline constexpr std::int32_t kGrowthAlongMm = 4000;
inline constexpr std::int32_t kGrowthAcrossMm = 2000;
inline constexpr std::int32_t kRecedingGrowthMm = 1000;  // while it has no heading
inline constexpr std::uint32_t kSmallCluster = 8;        // hits, and one for each update

// A young track takes the cluster whose edges lie so near.
inline constexpr std::int32_t kAssociateMm = 600;
inline constexpr std::int32_t kAssociateDeviations = 3;

// A track is born of so many hits, at rest.
inline constexpr std::uint32_t kBirthHits = 2;
inline constexpr std::int32_t kBirthPlaceMm = 100;  // deviations
inline constexpr std::int32_t kBirthSpeed = 10'000;

// Measurement.
inline constexpr std::int32_t kSlabMm = 250;       // so near the outermost hit is an edge
inline constexpr std::int32_t kFacingMm = 300;     // the car is so far before or behind a face
inline constexpr std::int32_t kFaceMm = 50;        // deviation of a face,
inline constexpr std::int32_t kHitMm = 90;         // and of a hit of it
inline constexpr std::int32_t kEndMm = 80;         // of an end,
inline constexpr std::int32_t kBeamsOfAMetre = 9;  // and between beams, by metres of range
inline constexpr std::int32_t kHiddenEndMm = 300;
inline constexpr std::uint32_t kHiddenFrom = 6;  // updates
inline constexpr std::int32_t kEndGateMm = 200;
inline constexpr std::int32_t kFarGateMm = 500;  // of the end of a side that is seen from beside
inline constexpr std::uint32_t kCutFrom = 3;     // updates: innovations are cut
inline constexpr std::int32_t kCutMm = 100;
inline constexpr std::int32_t kLeastVariance = 100;
inline constexpr std::int32_t kThinnestMm = 50;

// The box follows its edges by one part in so many.
inline constexpr std::int32_t kFollowMeasured = 16;
inline constexpr std::int32_t kFollowOutward = 2;
inline constexpr std::int32_t kFollowInward = 32;

// The box turns towards its velocity.
inline constexpr std::uint32_t kTurnFrom = 6;  // updates
inline constexpr std::int32_t kTurnSpeed = 1500;
inline constexpr std::int32_t kTurnDeviations = 4;
inline constexpr std::int32_t kTurnMovingDeviations = 3;  // a unit of 10 Hz leaves 0.7 m/s
inline constexpr std::int32_t kTurnSureSpeed = 600;  // of what is surely a car, and one deviation
inline constexpr std::int32_t kTurnShare = 4;
inline constexpr std::int32_t kTurnSlowShare = 8;
inline constexpr std::int32_t kWheelsShare = 8;  // of the speed across fades: wheels do not slide
inline constexpr std::int32_t kWheelsSpeed = 15'000;

// Two tracks are one thing.
inline constexpr std::uint32_t kMergeFrom = 6;  // updates
inline constexpr std::int32_t kMergeMm = 500;
inline constexpr std::int32_t kMergeSpeed = 1500;
inline constexpr std::int32_t kMergeMovingSpeed = 4000;  // both move, and neither is a walker
inline constexpr std::int32_t kMergeWidestMm = 3200;
inline constexpr std::int32_t kMergeReachMm = 20'000;

// Whether the grid agrees that it has moved.
inline constexpr std::size_t kSnapshots = 8;
inline constexpr std::size_t kSnapshotHits = 12;
inline constexpr std::uint64_t kSnapshotUs = 75'000;  // 80 ms, whatever the frames' ends
inline constexpr std::int32_t kShownWayMm = 700;
inline constexpr std::int32_t kShownMostMs = 700;
inline constexpr std::int32_t kShownLeastMs = 160;
inline constexpr std::int32_t kLeftMm = 250;  // so far out of the box is out of it
inline constexpr std::int32_t kOpenSpeed = 3000;

// The trail of a receding track. Its own beams pass at least so many of the places that it has
// left, and kGoodOverBad times as many as are hit again.
inline constexpr std::int32_t kTrailPlaces = 3;
inline constexpr std::int32_t kTrail = 4;
inline constexpr std::int32_t kMostTrail = 8;
inline constexpr std::int32_t kBesideMm =
    200;  // a beam that passes a place is so close to it, and kBeamsOfAMetre more

// Judgement.
inline constexpr std::int32_t kMoveSpeed = 600;
inline constexpr std::int32_t kMoveDeviations = 2;
inline constexpr std::int32_t kToldSpeed = 400;
inline constexpr std::int32_t kToldPercent = 40;
inline constexpr std::int32_t kToldHits = 2;
inline constexpr std::int32_t kGoodHits = 3;
inline constexpr std::int32_t kGoodOverBad = 4;
inline constexpr std::int32_t kBadOverGood = 8;
// So much good at such a speed convinces sooner: the car is soon past it.
inline constexpr std::int32_t kClearSpeed = 15'000;
inline constexpr std::int32_t kClearHits = 8;
// So many updates of a box like a car's, and so much good.
inline constexpr std::uint32_t kSteadyFrom = 50;
inline constexpr std::int32_t kSteadyHits = 2;
inline constexpr std::int32_t kShortestCarMm = 2500;
inline constexpr std::int32_t kLongestCarMm = 6000;
inline constexpr std::int32_t kNarrowestCarMm = 1200;
inline constexpr std::int32_t kWidestCarMm = 2800;
inline constexpr std::int32_t kOrdinaryWidthMm = 1600;  // of a car
// What a beam draws on the ground: fewer hits than so many, of a box as long as a walker is not,
// and narrower than so much;
inline constexpr std::int32_t kStreakHits = 8;
inline constexpr std::int32_t kStreakMm = 300;
// shorter, as a row of a few cells;
inline constexpr std::int32_t kRowHits = 4;
inline constexpr std::int32_t kRowMm = 100;
inline constexpr std::int32_t kShortestRowMm = 500;
// or wider, with less than a hit in so much of its length.
inline constexpr std::int32_t kSparseMm = 250;
inline constexpr std::int32_t kWidestSparseMm = 2000;
inline constexpr std::int32_t kStreakSpeed = 15'000;  // nothing that is drawn seems faster
inline constexpr std::int32_t kGroupSpeed = 1500;     // so slow are walkers side by side,
inline constexpr std::int32_t kGroupPercent = 75;     // of whom the grid calls so much moving
inline constexpr std::int32_t kMostConfidence = 12;
inline constexpr std::int32_t kMovingConfidence = 5;
inline constexpr std::int32_t kSureConfidence = 8;  // what stands within a car is its own
inline constexpr std::uint32_t kMovesFrom = 4;      // updates
inline constexpr std::int32_t kStopSpeed = 300;
inline constexpr std::int32_t kStopMs = 400;
inline constexpr std::int32_t kStayMm = 180;  // what has not come so far
inline constexpr std::int32_t kStayMs = 480;  // in so long has stopped, too
inline constexpr std::int32_t kParkedHits = 3;
inline constexpr std::int32_t kParkedOverOthers = 4;
inline constexpr std::int32_t kParkedSpeed = 3000;
inline constexpr std::uint64_t kUnseenUs = 480'000;       // moves, or has stopped
inline constexpr std::uint64_t kUnseenYoungUs = 100'000;  // any other
inline constexpr std::int32_t kNoThingMm = 20'000;
inline constexpr std::int32_t kNoThingAcrossMm = 4000;  // nothing on a road is so wide

// How sure of its velocity a track is said to be (objects/stated.hpp).
inline constexpr std::uint64_t kStatedAgeMs = 5000;
inline constexpr std::int32_t kStatedNearMm = 10'000;
inline constexpr std::uint64_t kStatedNear = 4;

// What was called moving and is so far out of every box that moves is not any more.
inline constexpr std::int32_t kTailMm = 300;

}  // namespace iog::objects
