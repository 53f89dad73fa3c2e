// Everything in a simulated world that moves: the car itself, other cars, people on the pavement.
//
// Stations and `left` are those of the road, speeds are metres per second along it.
#pragma once

#include <vector>

#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/script.hpp"
#include "tools/simulate/world/street_furniture.hpp"

namespace iog::tools {

// Where the car is, and how it leans.
struct EgoPose {
  Placement at;  // the vehicle frame's origin on the ground
  double pitch_cos = 1;
  double pitch_sin = 0;  // positive: the nose is down
  double station = 0;
  double z = 0;  // of the vehicle frame's origin
  double roll_cos = 1;
  double roll_sin = 0;  // positive: the left side is up
};

// How the car itself drives: in one lane, in which it weaves, at a speed that swings about its
// mean.
struct Cruise {
  double mean_speed;
  double speed_swing;   // less than the mean
  double swing_period;  // seconds
  double left;          // the lane's middle
  double weave = 0.15;  // how far to either side the car weaves

  // The way that the car has gone after so many seconds.
  [[nodiscard]] double station_at(double time_s) const;

  // When it comes to a station, at most 800 s after the start.
  [[nodiscard]] double time_at(double station) const;

  [[nodiscard]] EgoPose pose_at(const Road& road, double time_s) const;
};

struct Traffic {
  // A car that stays by: ahead of the car itself, or behind it if that is negative.
  struct Companion {
    double ahead;
    double swing;         // of that distance
    double swing_period;  // seconds
    double left;
    CarShape shape;
  };
  // A car that drives on at its speed; against the road's direction if that is negative.
  struct Car {
    double station;  // at time 0
    double left;
    double speed;
    CarShape shape;
  };
  // A car on a street that crosses the road.
  struct Crosser {
    double junction;  // station of its middle
    double passes_s;  // when it is there
    double left;      // of the middle of its own street
    double speed;
    double side;  // 1: from right to left, -1: from left to right
    CarShape shape;
  };
  struct Walker {
    double station;  // at time 0
    double left;
    double speed;
  };

  std::vector<Companion> companions;
  std::vector<Crosser> crossers;
  std::vector<Car> cars;
  std::vector<Walker> walkers;
  std::vector<ScriptedCar> scripted_cars;
  std::vector<ScriptedWalker> scripted_walkers;

  // Appends everything that may be seen from that station at that time, with companions of the car
  // that drives so. What a script does not number has numbers from kFirstMover on.
  void append_seen_from(double station, const Road& road, const Cruise& cruise, double time_s,
                        std::vector<Solid>& solids) const;
};

}  // namespace iog::tools
