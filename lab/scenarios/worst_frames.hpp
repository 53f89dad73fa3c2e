// Frames that cost the reference car as much as frames can: no scene looks like them. Their scans
// are put together point by point, each frame hard on another part of the fusion.
//
// The decoder believes every point, and no scan has more of them than the car's description allows.
// Some of the scans a LUX could send: four layers, directions half a degree apart, up to three
// echoes a beam. The others are forged: the format allows them, so a bound has to cover them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/simulate/drives/pose_source.hpp"
#include "tools/simulate/random.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

struct WorstFrame {
  std::string_view name;
  std::string_view strain;  // what it is hard on
  bool is_forged;           // no LUX sends such a scan
  std::vector<tools::LuxPoint> (*points)(const vehicle::Sensor& sensor, tools::Random& random);
};

[[nodiscard]] std::span<const WorstFrame> all_worst_frames();

// So many of each kind are measured on the target.
inline constexpr std::uint32_t kMeasuredWorstFrames = 4;

// UsageError with the known names if there is no such frame.
[[nodiscard]] const WorstFrame& find_worst_frame(std::string_view name);

// What the car's scanners send for frame 0, 1, ...: each of them drawn anew, the same for the same
// seed. One point of a scan is up to 7 cm beside where it would be: whoever sends the same scan
// twice is frozen (docs/spec.md 1.4).
[[nodiscard]] std::vector<tools::CapturedDatagram> worst_datagrams(const WorstFrame& worst,
                                                                   std::uint64_t seed,
                                                                   std::uint32_t frame);

// The poses that such a car sends until so many of its frames have ended: it goes straight ahead at
// 15 m/s, and says so without an error.
[[nodiscard]] tools::PoseFeed poses_of_worst_frames(std::uint32_t frames);

}  // namespace iog::lab
