// The gate of a track is the area around its box in which the track claims hits.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "numeric/square_root.hpp"
#include "objects/rules.hpp"
#include "objects/track.hpp"

namespace iog::objects {

struct ClaimGate {
  std::int32_t mm = 0;               // extent beyond the box, for hits that are not standing
  std::int32_t speed_deviation = 0;  // standard deviation, the larger of the two axes, mm/s
};
using ClaimGates = std::array<ClaimGate, kMostTracks>;

[[nodiscard]] inline std::int32_t root_of(std::int32_t variance) {
  return static_cast<std::int32_t>(
      numeric::square_root(static_cast<std::uint64_t>(std::max<std::int32_t>(variance, 1))));
}

[[nodiscard]] inline ClaimGate claim_gate_of(const Track& track) {
  const auto larger = [&](auto entry) {
    return root_of(std::max(entry(track.covariance(kAlong)), entry(track.covariance(kAcross))));
  };
  const std::int32_t deviation = 2 * larger([](const Covariance& its) { return its.place(); });
  const bool is_settled = track.updates >= kSettledFrom;
  return {.mm = is_settled ? kGateSettledMm + std::min(deviation, kMostGateDeviationSettledMm)
                           : kGateMm + std::min(deviation, kMostGateDeviationMm),
          .speed_deviation = larger([](const Covariance& its) { return its.speed(); })};
}

}  // namespace iog::objects
