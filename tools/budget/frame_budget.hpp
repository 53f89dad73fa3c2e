// What a frame of a vehicle takes the target, by the cost model of the Cortex-A9, before anybody
// has built it: the numbers of its description times what their units cost (unit_costs.hpp).
//
// It is modelled, not measured, and of one core at 1 GHz. Typical is a frame in which the sensors
// see as much of what they could see as the reference car, or a unit that turns on a roof, does on
// the drives of lab/data, a point a direction. Worst is one that the description allows at most:
// each direction as dear as the dearest that is known, all later echoes, and every tile in reach
// known.
#pragma once

#include <cstddef>
#include <string>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

inline constexpr double kMsPerCycle = 1e-6;  // at 1 GHz

// How much there is to do in a frame.
struct FrameWork {
  double points = 0;         // of azimuths that come again in each scan: their lines are kept
  double turn_steps = 0;     // azimuth steps of level units that turn, of which the lines are kept
  double turn_points = 0;    // their points
  double tilted_points = 0;  // of units that turn and are not level
  double points_once = 0;    // of others, whose azimuths never repeat
  double ground_turns = 0;   // of units that follow the ground
  double ground_points = 0;  // their points, which count above, too
  double moved_frames = 0;   // with classes, in which ground is opened only from below
  double moved_points = 0;   // of units that say so, which count above, too
  double later_echoes = 0;
  double arc_steps = 0;   // of the arcs of detections, each about as dear as a later echo
  double cone_cells = 0;  // looked at in cones of ultrasonic units
  double cells = 0;       // carved by `points`
  double tiles = 0;       // known
  double class_tiles = 0;
};

struct FrameBudget {
  FrameWork work{};
  double ms = 0;
};

struct VehicleBudget {
  FrameBudget typical{};
  FrameBudget worst{};
  double period_ms = 0;
};

[[nodiscard]] VehicleBudget budget_of(const CatalogueEntry& car);

// Of typical work and typical costs.
[[nodiscard]] double typical_ms(const FrameWork& work);

// What of it follows the ground, and what opens it only from below.
[[nodiscard]] double ground_ms(const FrameWork& work);
[[nodiscard]] double moved_ms(const FrameWork& work);

// A table for a person: one line a frame, then which data it is of and how far it is off.
[[nodiscard]] std::string words_of_budget(const CatalogueEntry& car);
[[nodiscard]] std::string words_of_budget_errors();

// Fewest cores on which what takes one core so long is done within the period, if what is divided
// among them is divided as a frame with classes is; 0 if that takes more than there are.
[[nodiscard]] std::size_t cores_for(double ms, double period_ms);

// A line: on how many cores the vehicle's frames are within its period.
[[nodiscard]] std::string line_of_cores(const CatalogueEntry& car);

// A line, if a typical frame is longer than the vehicle's period; else empty. It is no refusal: the
// target leaves what it is too slow for (app/backlog.hpp), and the model may be off.
[[nodiscard]] std::string warning_of_budget(const CatalogueEntry& car);

}  // namespace iog::tools
