// A vehicle description as a person writes it: one aggregate per car, in metres and degrees.
//
// Only the compiler and the PC's tools see these numbers; vehicle/vehicle.hpp turns them into the
// integers that run on the target. One file per vehicle in vehicles/.
//
// Vehicle frame (ISO 8855): x forward, y left, z up from the ground, metres. The origin lies in the
// middle of the grid. A mount turns the sensor frame by yaw about z, then pitch about y, then roll
// about x: R = Rz(yaw) Ry(pitch) Rx(roll), so a positive pitch looks down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lidar/scan_point.hpp"
#include "sensor_model/profile.hpp"

namespace iog::vehicle {

struct MountConfig {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double yaw_deg = 0;    // -360 ... 360, positive to the left
  double pitch_deg = 0;  // -90 ... 90, positive down
  double roll_deg = 0;   // -360 ... 360, positive to the right
};

struct SensorConfig {
  std::string_view name;  // for people: at most 15 letters, digits, '_'
  lidar::Format format = lidar::Format::kIbeoLux;
  std::uint32_t source_ipv4 = 0;  // the sensor's address, 0: any
  std::uint16_t udp_port = 0;     // where its packets arrive; one port for each sensor
  MountConfig mount{};
  std::uint32_t range_min_mm = 0;         // nearer points are dropped
  std::uint32_t range_max_mm = 50'000;    // L: the length of the local 1D grid, < 2^18
  std::uint32_t precision_mm = 100;       // Delta: the length of a 1D cell
  double sigma_m = 0.10;                  // standard deviation of the range
  std::uint32_t no_return_clears_mm = 0;  // a missing return carves up to here; 0: no evidence
  std::uint16_t scan_width_ticks = 0;     // azimuth of a whole scan, in ticks of the format
  std::uint32_t max_points_per_scan = 0;  // more than this in one frame are refused
};

// A rectangle on the ground, seen from above.
struct FootprintConfig {
  double x_min_m = 0;
  double x_max_m = 0;
  double y_min_m = 0;
  double y_max_m = 0;
};

// The two rules of docs/model.md section 3.
enum class FusionRule : std::uint8_t { kHitsWin, kBayes };

struct Description {
  std::string_view name;
  FootprintConfig footprint{};  // points inside are the car's own
  double z_min_m = 0.0;         // the height band: only this part of a beam is evidence
  double z_max_m = 2.0;
  double epsilon = 0.05;  // of the recursive set
  index::Quantisation quantisation = index::Quantisation::kBlurring;
  FusionRule rule = FusionRule::kHitsWin;
  std::uint32_t frame_period_us = 40'000;  // a frame is over after this long at the latest
};

}  // namespace iog::vehicle
