// The simulated hills: a road of two lanes that climbs and falls by up to 10 degrees, in acts of
// 220 metres, which are alike but for what the seed decides: how high the hills are, cars, trees,
// people.
//
//   station, m   what
//   10 ... 60    climbs, by 10 degrees at most
//   66           a gate of 2.5 m clearance across the road
//   60 ... 108   falls, by 7.4 degrees at most
//   86 ... 94    a bridge over the road, 4.6 m above it
//   108 ... 126  a ramp: up 8.5 degrees within four metres, level again two metres higher
//   140 ... 200  falls, by 4.9 degrees at most, to the height of the begin
//
// To the right are parking cars with windows, a kerb of 12 cm, a pavement, a verge and a bank that
// falls by 2.2 m; to the left a verge and a bank that rises by 2.5 m, with trees on it. The car
// drives in the right lane at 8 to 10 m/s.
#pragma once

#include <cstdint>

#include "tools/simulate/world/scene.hpp"

namespace iog::tools {

inline constexpr double kHillsActM = 220;
inline constexpr double kHillsGateM = 66;    // station in its act
inline constexpr double kHillsBridgeM = 90;  // of its middle

[[nodiscard]] Scene make_hills(std::uint64_t seed, double drive_s);

}  // namespace iog::tools
