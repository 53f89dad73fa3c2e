// Defines all parameters of tracking (docs/objects.md).
//
// Unless a name indicates otherwise, lengths are in mm, speeds in mm/s and times in ms. The values
// are part of the algorithm and are the same for all cars.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::objects {

// Capacities that limit the cost of a frame. Elements that exceed a capacity are dropped and
// counted.
inline constexpr std::size_t kMostHits = 8192;
inline constexpr std::size_t kMostTracks = 256;
inline constexpr std::size_t kMostClusters = 256;
inline constexpr std::size_t kMostTracksOfATile = 16;  // tracks that may take hits in one tile
inline constexpr std::size_t kMostAsked = 16;          // tracks with which a cluster is compared

// All tracks end if the time between two frames exceeds kLongestStepMs or is not positive. For
// example, a gap of 400 ms occurs if three successive 100 ms turns of a spinning lidar are lost.
inline constexpr std::int32_t kLongestStepMs = 450;
// If the last measurement is older than kLongestToldMs, no objects are published or labelled.
inline constexpr std::int32_t kLongestToldMs = 200;

// The capacities of views that the end of a frame has cut. Views beyond them stay in two parts.
inline constexpr std::size_t kMostCutTracks = 32;
inline constexpr std::size_t kMostCutHits = 1024;
// A frame begins where the last one ended if at most this time is between their slices.
inline constexpr std::int32_t kCutGapMs = 20;
// A lidar that turns ten times per second sees an object again after more than this time.
inline constexpr std::int32_t kTurnGapMs = 50;

// Recent hits are recorded in epochs of 80 ms.
inline constexpr std::uint64_t kEpochUs = 80'000;
inline constexpr std::int32_t kEpochMs = 80;
inline constexpr int kOldEpochs = 4;  // a place that was first hit this many epochs ago is old

// The process noise of the speed, in mm/s per root second.
inline constexpr std::int32_t kWanderAlong = 1500;
inline constexpr std::int32_t kWanderAcross = 700;
// kWanderAcrossFast applies at speeds of kWheelsSpeed and above, because the direction of the
// velocity changes in bends.
inline constexpr std::int32_t kWanderAcrossFast = 1200;
inline constexpr std::int32_t kWanderSmall = 700;
inline constexpr std::int32_t kSmallMm = 1200;     // a pedestrian is at most this large
inline constexpr std::int32_t kSmallSpeed = 3000;  // and this fast
inline constexpr std::int32_t kMostSpeed = 100'000;

// The acceleration of road users is limited by their tyres or legs. After kGripFrom updates, the
// speed of a moving track changes by at most kGrip mm/s per second along each axis. Braking and
// cornering accelerations reach 10 m/s^2.
inline constexpr std::uint32_t kGripFrom = 12;
inline constexpr std::int32_t kGrip = 10'000;

// The gate of a track is the area around its box in which the track claims hits. For hits that are
// not standing, the gate is extended by twice the standard deviation of the position, up to the
// limits below.
inline constexpr std::uint32_t kClaimsFrom = 3;  // updates
inline constexpr std::uint32_t kSettledFrom = 12;
inline constexpr std::int32_t kGateMm = 300;
inline constexpr std::int32_t kGateSettledMm = 250;
inline constexpr std::int32_t kGateStandingMm = 250;
inline constexpr std::int32_t kMostGateDeviationMm = 600;
inline constexpr std::int32_t kMostGateDeviationSettledMm = 300;

// A hit contradicts a track if the same place was already hit before the track could have reached
// it.
inline constexpr std::uint32_t kContradictedFrom = 6;  // updates
inline constexpr int kContradictingEpochs = 3;
inline constexpr std::int32_t kStandingAgeMs = 800;
inline constexpr std::int32_t kEpochSlackMs = 20;
inline constexpr std::int32_t kContradictionMm = 150;

// Hits that are at most this far apart belong to the same object.
inline constexpr std::int32_t kGapMm = 400;
inline constexpr std::int32_t kGapOfAMetre = 14;  // additional gap per metre of range

// These values determine whether a cluster next to a track is attached to it.
inline constexpr std::int32_t kAttachMm = 300;  // in addition to the gap
inline constexpr std::int32_t kHeadwayMs = 50;  // no road user follows a moving object more closely
inline constexpr std::int32_t kLongestMm = 18'000;
inline constexpr std::int32_t kWidestMm = 3400;
inline constexpr std::int32_t kGrowthAlongMm = 4000;
inline constexpr std::int32_t kGrowthAcrossMm = 2000;
inline constexpr std::int32_t kRecedingGrowthMm = 1000;  // of a receding track without a heading
inline constexpr std::uint32_t kSmallCluster = 8;        // hits, plus one for each update

// A young track is associated with a cluster if the cluster's edges are within this distance of the
// track's edges.
inline constexpr std::int32_t kAssociateMm = 600;
inline constexpr std::int32_t kAssociateDeviations = 3;

// A new track has at least kBirthHits hits and starts with a speed of 0.
inline constexpr std::uint32_t kBirthHits = 2;
inline constexpr std::int32_t kBirthPlaceMm = 100;  // standard deviations of position and speed
inline constexpr std::int32_t kBirthSpeed = 10'000;

// Parameters of the measurement.
inline constexpr std::int32_t kSlabMm = 250;  // hits this close to the outermost hit form an edge
// The car can see a face of the box if it is more than kFacingMm in front of this face.
inline constexpr std::int32_t kFacingMm = 300;
inline constexpr std::int32_t kFaceMm = 50;        // standard deviation of a face
inline constexpr std::int32_t kHitMm = 90;         // standard deviation of one hit of a face
inline constexpr std::int32_t kEndMm = 80;         // standard deviation of an end
inline constexpr std::int32_t kBeamsOfAMetre = 9;  // spacing of beams per metre of range
inline constexpr std::int32_t kHiddenEndMm = 300;
inline constexpr std::uint32_t kHiddenFrom = 6;  // updates
inline constexpr std::int32_t kEndGateMm = 200;
inline constexpr std::int32_t kFarGateMm = 500;  // gate of the far end if seen at an angle
inline constexpr std::uint32_t kCutFrom = 3;     // updates from which innovations are limited
inline constexpr std::int32_t kCutMm = 100;
inline constexpr std::int32_t kLeastVariance = 100;
inline constexpr std::int32_t kThinnestMm = 50;

// In each update, a measured edge of the box moves towards its new position by 1/16 of the
// difference. Any other edge moves outwards by 1/2 of the difference or inwards by 1/32 of it.
inline constexpr std::int32_t kFollowMeasured = 16;
inline constexpr std::int32_t kFollowOutward = 2;
inline constexpr std::int32_t kFollowInward = 32;

// These values determine when the box of a track turns towards its velocity.
inline constexpr std::uint32_t kTurnFrom = 6;  // updates
inline constexpr std::int32_t kTurnSpeed = 1500;
inline constexpr std::int32_t kTurnDeviations = 4;
// kTurnMovingDeviations applies to moving tracks because the standard deviation of their speed is
// 0.7 m/s with a 10 Hz scanner.
inline constexpr std::int32_t kTurnMovingDeviations = 3;
// The box of a track that is certainly a car also turns if the speed reaches both kTurnSureSpeed
// and its own standard deviation.
inline constexpr std::int32_t kTurnSureSpeed = 600;
inline constexpr std::int32_t kTurnShare = 4;
inline constexpr std::int32_t kTurnSlowShare = 8;
// In each frame, the lateral speed of the box is reduced by 1/8, because wheels do not slide
// sideways.
inline constexpr std::int32_t kWheelsShare = 8;
inline constexpr std::int32_t kWheelsSpeed = 15'000;

// These limits determine which tracks are merged because they belong to the same object.
inline constexpr std::uint32_t kMergeFrom = 6;  // updates
inline constexpr std::int32_t kMergeMm = 500;
inline constexpr std::int32_t kMergeSpeed = 1500;
inline constexpr std::int32_t kMergeMovingSpeed = 4000;  // if both are moving and neither is a
                                                         // pedestrian
inline constexpr std::int32_t kMergeWidestMm = 3200;
inline constexpr std::int32_t kMergeReachMm = 20'000;

// Parameters for using the grid to confirm the motion of a track.
inline constexpr std::size_t kSnapshots =
    10;  // reach back over kShownMostMs with frames of 25 ms or more
inline constexpr std::size_t kSnapshotHits = 12;
// The interval between snapshots is shorter than an epoch because frames do not end at regular
// intervals.
inline constexpr std::uint64_t kSnapshotUs = 75'000;
inline constexpr std::int32_t kShownWayMm = 700;
inline constexpr std::int32_t kShownTrailMm = 1000;  // of a receding track of at least kSmallMm
inline constexpr std::int32_t kShownMostMs = 700;
inline constexpr std::int32_t kShownLeastMs = 160;
inline constexpr std::int32_t kLeftMm = 250;  // the track has left a place that is this far outside
                                              // its box
inline constexpr std::int32_t kOpenSpeed = 3000;
inline constexpr std::int32_t kCarStandsSpeed = 1000;  // a faster car has seen near cells from afar

// Parameters of the trail of a receding track. The trail consists of the places that the track has
// left. A frame supports the trail if the track's own beams pass at least kTrailPlaces of these
// places, and if they pass at least kGoodOverBad places for each place that is hit again. A beam
// passes a place if it misses the place by at most kBesideMm. A place that is still occupied is hit
// again within kLayersMs, even if the sensor scans its layers one after the other. If the track is
// slower than kLayersSpeed, recently hit places therefore also count as hit again. Hits behind a
// track that is faster than kLayersSpeed may belong to the track itself, because its speed is not
// known well enough.
inline constexpr std::int32_t kTrailPlaces = 3;
inline constexpr std::int32_t kTrail = 4;
inline constexpr std::int32_t kMostTrail = 8;
inline constexpr std::int32_t kLayersMs = 260;  // two epochs, and the age of a turn's hits
inline constexpr std::int32_t kLayersSpeed = 3000;
inline constexpr std::int32_t kBesideMm = 200;  // plus kBeamsOfAMetre per metre of range

// Parameters of confidence and state.
inline constexpr std::int32_t kMoveSpeed = 600;
inline constexpr std::int32_t kMoveDeviations = 2;
inline constexpr std::int32_t kToldSpeed = 400;
inline constexpr std::int32_t kToldPercent = 40;
inline constexpr std::int32_t kToldHits = 2;
inline constexpr std::int32_t kGoodHits = 3;
inline constexpr std::int32_t kGoodOverBad = 4;
inline constexpr std::int32_t kBadOverGood = 8;
// If a track has at least kClearHits good places and a speed of at least kClearSpeed, its
// confidence increases faster, because our car will soon have passed the object.
inline constexpr std::int32_t kClearSpeed = 15'000;
inline constexpr std::int32_t kClearHits = 8;
// After kSteadyFrom updates, kSteadyHits good places are enough to confirm the motion of a
// car-sized track.
inline constexpr std::uint32_t kSteadyFrom = 50;
inline constexpr std::int32_t kSteadyHits = 2;
inline constexpr std::int32_t kShortestCarMm = 2500;
inline constexpr std::int32_t kLongestCarMm = 6000;
inline constexpr std::int32_t kNarrowestCarMm = 1200;
inline constexpr std::int32_t kWidestCarMm = 2800;
inline constexpr std::int32_t kOrdinaryWidthMm = 1600;  // width of a car
// A streak is a line of hits from a beam that grazes the ground. A streak has fewer than
// kStreakHits hits, is longer than a pedestrian and is narrower than kStreakMm.
inline constexpr std::int32_t kStreakHits = 8;
inline constexpr std::int32_t kStreakMm = 300;
// A row of only a few cells also counts as a streak, even if it is no longer than a pedestrian.
inline constexpr std::int32_t kRowHits = 4;
inline constexpr std::int32_t kRowMm = 100;
inline constexpr std::int32_t kShortestRowMm = 500;
// An object that is wider than kStreakMm also counts as a streak if it has less than one hit per
// kSparseMm of length.
inline constexpr std::int32_t kSparseMm = 250;
inline constexpr std::int32_t kWidestSparseMm = 2000;
inline constexpr std::int32_t kStreakSpeed = 15'000;  // streaks never seem to move faster
inline constexpr std::int32_t kGroupSpeed = 1500;     // pedestrian groups are slower than this,
inline constexpr std::int32_t kGroupPercent = 75;     // and most of their hits are moving
inline constexpr std::int32_t kMostConfidence = 12;
inline constexpr std::int32_t kMovingConfidence = 5;
// A car-sized track is certainly a car if its confidence is at least kSureConfidence and at least
// kSureUnopposed frames have supported its motion. Standing hits in the box of such a track belong
// to the track. A frame opposes the motion if it has fewer than kGoodOverBad good or neutral places
// per bad place. Each frame that opposes the motion cancels kOpposed frames that support it. A
// frame that does not oppose the motion supports it if at least kSteadyHits places are good.
inline constexpr std::int32_t kSureConfidence = 8;
inline constexpr std::int32_t kSureUnopposed = 4;
inline constexpr std::int32_t kMostUnopposed = 12;
inline constexpr std::int32_t kOpposed = 2;
inline constexpr std::uint32_t kMovesFrom = 4;  // updates
inline constexpr std::int32_t kStopSpeed = 300;
inline constexpr std::int32_t kStopMs = 400;
inline constexpr std::int32_t kStayMm = 180;  // a track that moves less than this
inline constexpr std::int32_t kStayMs = 480;  // in this time has stopped, too
inline constexpr std::int32_t kParkedHits = 3;
inline constexpr std::int32_t kParkedOverOthers = 4;
inline constexpr std::int32_t kParkedSpeed = 3000;
inline constexpr std::uint64_t kUnseenUs = 480'000;       // moving or stopped tracks
inline constexpr std::uint64_t kUnseenYoungUs = 100'000;  // all other tracks
inline constexpr std::int32_t kNoThingMm = 20'000;
inline constexpr std::int32_t kNoThingAcrossMm = 4000;  // no road user is wider than this

// Parameters for the reported standard deviation of a velocity (objects/stated.hpp).
inline constexpr std::uint64_t kStatedAgeMs = 5000;
inline constexpr std::int32_t kStatedNearMm = 10'000;
inline constexpr std::uint64_t kStatedNear = 4;

// A moving cell loses the class `moving` if it is more than kTailMm outside the boxes of all moving
// tracks.
inline constexpr std::int32_t kTailMm = 300;

}  // namespace iog::objects
