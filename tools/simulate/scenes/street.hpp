// The simulated street: acts of 20 seconds in which cars park and leave, people walk and stop, and
// a bus is hidden for a while, all by a timetable.
//
// The car drives at 0.1 ... 7.9 m/s: in the middle of an act it nearly stands, and what happens
// happens up to 40 m ahead of it. Act n begins at 20 n seconds and 80 n metres; times and stations
// below are from there. Every act is the same, whatever the seed; houses, parked cars and the other
// people on the pavement are the seed's.
//
//   time, s       who       what
//   2.5           visitor   leaves the right kerb at 40 m, where it has always stood
//   5             oncomer   passes 100.4 m in the other lane, and goes on at 9 m/s
//   10.5          crosser   has stood at the left kerb for 2.5 s; crosses at 77.4 m until 19.375 s
//   13 ... 18     stroller  stands on the right pavement at 93.2 m
//   14.62         visitor   has parked at the right kerb, at 92.4 m, for good
//   15            leaver    leaves the right kerb at 80.4 m, where it has always stood
//   15.2 ... 18.5 delivery  a lorry stands in the other lane at 90 m: the bus is hidden from
//                           14.5 to 19.5 s, and is seen before and behind
//   22            bus       leaves the left kerb at 100.4 m, where it has always stood
#pragma once

#include <cstdint>

#include "tools/simulate/world/scene.hpp"

namespace iog::tools {

inline constexpr double kStreetActS = 20;
inline constexpr double kStreetActM = 80;

// Who plays in every act.
enum class StreetRole : std::uint8_t {
  kVisitor,
  kLeaver,
  kOncomer,
  kDelivery,
  kBus,
  kCrosser,
  kStroller
};

// The number of that thing in the truth. act: from -1 on.
[[nodiscard]] constexpr std::uint32_t street_thing(int act, StreetRole role) {
  constexpr std::uint32_t kFirst = 2 * kFirstMover;
  return kFirst + static_cast<std::uint32_t>(act + 1) * 16 + static_cast<std::uint32_t>(role);
}

[[nodiscard]] Scene make_street(std::uint64_t seed, double drive_s);

}  // namespace iog::tools
