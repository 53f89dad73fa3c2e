// The part of the simulated city that does not move: a street of two lanes with parked cars, kerbs,
// pavements, buildings, parks and junctions.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tools/simulate/road.hpp"
#include "tools/simulate/solid.hpp"

namespace iog::tools {

// The cross-section, in metres from the centre line.
inline constexpr double kLaneCentre = 1.75;
inline constexpr double kParkingCentre = 4.65;
inline constexpr double kKerb = 5.80;
inline constexpr double kPavementCentre = 7.60;
inline constexpr double kHalfJunction = 8.0;

// How far anything is seen, and how far beyond both ends of the drive the city reaches.
inline constexpr double kSight = 210.0;

class City {
 public:
  // A city for a drive of that length. The same seed builds the same city.
  City(std::uint64_t seed, double drive_m);

  [[nodiscard]] const Road& road() const { return road_; }

  // Stations of the junctions' middles, ascending.
  [[nodiscard]] std::span<const double> junctions() const { return junctions_; }

  // Appends everything that may be seen from that station.
  void append_seen_from(double station, std::vector<Solid>& solids) const;

 private:
  Road road_;
  std::vector<double> junctions_;
  std::vector<std::pair<double, Solid>> solids_;  // by station, ascending
};

}  // namespace iog::tools
