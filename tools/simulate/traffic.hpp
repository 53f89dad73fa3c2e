// Everything in the simulated city that moves: the car itself, other cars, people on the pavement.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/simulate/city.hpp"
#include "tools/simulate/street_furniture.hpp"

namespace iog::tools {

// Where the car is, and how it leans.
struct EgoPose {
  Placement at;  // the vehicle frame's origin on the ground
  double pitch_cos = 1;
  double pitch_sin = 0;  // positive: the nose is down
  double station = 0;
};

// The way that the car has gone after so many seconds, in metres.
[[nodiscard]] double ego_station(double time_s);

class Traffic {
 public:
  // city outlives the traffic.
  Traffic(const City& city, std::uint64_t seed, double drive_s);

  [[nodiscard]] EgoPose ego(double time_s) const;

  // Appends everything that moves and may be seen from the car at that time.
  void append_at(double time_s, std::vector<Solid>& solids) const;

 private:
  struct Walker {
    double station;  // at time 0
    double left;
    double speed;  // metres per second along the road
  };
  struct Oncomer {
    double station;  // at time 0
    CarShape shape;
  };
  struct Crosser {
    double junction;
    double passes_s;  // when it is in the middle of the junction
    double side;      // 1: from right to left
    CarShape shape;
  };

  void append_followers(double time_s, std::vector<Solid>& solids) const;
  void append_crossers(double time_s, std::vector<Solid>& solids) const;
  [[nodiscard]] bool is_seen(double station, double time_s) const;

  const City* city_;
  CarShape leader_;
  CarShape follower_;
  std::vector<Walker> walkers_;
  std::vector<Oncomer> oncomers_;
  std::vector<Crosser> crossers_;
};

}  // namespace iog::tools
