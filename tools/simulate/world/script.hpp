// Cars and people that follow a timetable: they stand, go and stand again at stated times.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/street_furniture.hpp"

namespace iog::tools {

// Where along a road something is. Between two calls station and speed are a cubic of time
// (Hermite); before the first and after the last one it keeps its speed.
class Timetable {
 public:
  struct Call {
    double time_s;
    double station;
    double speed;  // metres a second along the road, negative against it
  };

  // Calls in order of their times, at least one.
  explicit Timetable(std::vector<Call> calls);

  [[nodiscard]] double station_at(double time_s) const;

 private:
  std::vector<Call> calls_;
};

// A car that drives, parks and leaves.
struct ScriptedCar {
  // A place of its path. From one to the next it changes over without an edge (3 t^2 - 2 t^3).
  struct Knot {
    double station;
    double left;
  };

  std::uint32_t thing;  // its number, from kFirstMover on
  Timetable timetable;
  std::vector<Knot> path;  // by ascending station, at least one
  double direction;        // 1: its nose points along the road, -1: against it
  CarShape shape;

  // It points along its path, also when it stands.
  [[nodiscard]] Placement at(const Road& road, double time_s) const;
};

// Someone who walks straight from one place to the next, and stands where two places are one.
struct ScriptedWalker {
  struct Place {
    double time_s;
    double station;
    double left;
  };

  std::uint32_t thing;
  std::vector<Place> places;  // in order of their times, at least one

  [[nodiscard]] double station_at(double time_s) const { return place_at(time_s).station; }
  [[nodiscard]] Placement at(const Road& road, double time_s) const;

 private:
  [[nodiscard]] Place place_at(double time_s) const;
};

}  // namespace iog::tools
