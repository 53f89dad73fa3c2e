// A vehicle description: one aggregate per car, in metres and degrees, as its file has them.
//
// Only the PC sees these numbers; tools/car/tables.hpp makes of them the integers that run on the
// target. One file per vehicle in vehicles/ (docs/vehicles.md).
//
// Vehicle frame (ISO 8855): x forward, y left, z up from the ground, metres. By default the origin
// lies in the middle of the grid. A mount turns the sensor frame by yaw about z, then pitch about
// y, then roll about x: R = Rz(yaw) Ry(pitch) Rx(roll), so a positive pitch looks down.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "geometry/grid.hpp"
#include "lidar/formats.hpp"
#include "lidar/laser.hpp"
#include "lidar/unit.hpp"
#include "map/source_description.hpp"
#include "numeric/elementary.hpp"
#include "perception/rules.hpp"
#include "pose/source_description.hpp"
#include "sensor_model/profile.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::description {

struct MountConfig {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double yaw_deg = 0;    // -360 ... 360, positive to the left
  double pitch_deg = 0;  // -90 ... 90, positive down
  double roll_deg = 0;   // -360 ... 360, positive to the right
};

// Heights over the local ground, by which a sensor that turns judges its returns (docs/ground.md).
struct GroundConfig {
  double low_m = 0.22;
  double top_m = 2.20;
};

// How low a beam opens ground, and how tall something is that moves (docs/perception.md): over the
// car's plane, or over the local ground if the sensor follows it. A tall_m of 0: whatever is hit.
struct MovedConfig {
  double low_m = 0.6;
  double tall_m = 0.7;
};

struct SensorConfig {
  std::string_view name{};  // for people: at most 15 letters, digits, '_'
  lidar::Format format = lidar::kFormat<lidar::IbeoLux>;
  std::uint32_t source_ipv4 = 0;  // the sensor's address, 0: any
  std::uint16_t udp_port = 0;     // where its packets arrive; one port for each sensor
  MountConfig mount{};
  std::uint32_t range_min_mm = 0;         // nearer points are dropped
  std::uint32_t range_max_mm = 50'000;    // L: the length of the local 1D grid, < 2^18
  std::uint32_t precision_mm = 100;       // Delta: the length of a 1D cell
  double sigma_m = 0.10;                  // standard deviation of the range
  double azimuth_sigma_deg = 0;           // of an azimuth: of a radar, of a cone
  std::uint32_t no_return_clears_mm = 0;  // a missing return carves up to here; 0: no evidence
  std::uint16_t scan_width_ticks = 0;     // azimuth of a whole scan, in ticks of the format
  // Of a sensor that turns: its azimuth step as a part of a turn, 1/256 ... 1/16384 in powers of
  // two. 0: the largest that is at most a cell wide at range_max_mm. Other sensors have none, 0.
  std::uint32_t azimuth_steps_per_turn = 0;
  std::uint32_t max_points_per_scan = 0;  // more than this in one frame are refused
  // One for each layer of the format, as the maker calibrated this unit; none: as its data sheet
  // has them. Of static storage.
  std::span<const lidar::Laser> lasers{};
  lidar::TurnMode mode{};  // what an Ouster is set to
  // Of a scanner with a tilted mirror: how far its front's beams look down ahead, its rear's up.
  double beam_tilt_deg = 0;
  // Its clock is that of the poses, and both count from 1970-01-01 UTC. Else its packets were
  // measured so long before they came.
  bool is_synchronised = false;
  std::uint32_t latency_us = 0;
  // None: its returns are judged by the car's height band.
  std::optional<GroundConfig> ground{};
  // None: each of its beams opens what it frees.
  std::optional<MovedConfig> moved{};
};

// A rectangle on the ground, seen from above.
struct FootprintConfig {
  double x_min_m = 0;
  double x_max_m = 0;
  double y_min_m = 0;
  double y_max_m = 0;
};

// The cell size and the distances of the grid's edges from the vehicle's origin.
struct GridConfig {
  double cell_m = geometry::kCellMm / 1000.0;
  double ahead_m = geometry::kOriginCell * cell_m;
  double behind_m = geometry::kOriginCell * cell_m;
  double left_m = geometry::kOriginCell * cell_m;
  double right_m = geometry::kOriginCell * cell_m;
};

// The sides of the window of classes along x and y of the local frame; none: 1024 cells.
struct WindowConfig {
  std::optional<double> side_x_m{};
  std::optional<double> side_y_m{};
};

// The constants of Kurdej 2015, table 7.1 and section 7.3, that a car file can set. The accumulator
// is designed for an object of length L that moves at V_min at a distance d behind another object.
struct EvidenceConfig {
  double slowest_m_s = 1.0;  // V_min
  double object_m = 3.0;     // L
  double gap_m = 0.5;        // d
  std::uint16_t scans_per_second = 15;
  double free_mass = 0.7;  // of crossing beams in 100 ms
  double hit_mass = 0.87;
  double moving_half_life_s = 0.1 * numeric::log(0.5) / numeric::log(0.90);
  double static_half_life_s = 0.1 * numeric::log(0.5) / numeric::log(0.99);
  friend bool operator==(const EvidenceConfig&, const EvidenceConfig&) = default;
};

struct Description {
  std::string_view name;
  GridConfig grid{};
  FootprintConfig footprint{};  // points inside are the car's own
  double z_min_m = 0.0;         // the height band: only this part of a beam is evidence
  double z_max_m = 2.0;
  double epsilon = 0.05;  // of the recursive set
  index::Quantisation quantisation = index::Quantisation::kBlurring;
  vehicle::FusionRule rule = vehicle::FusionRule::kHitsWin;
  std::uint32_t frame_period_us = 40'000;  // a frame is over after this long at the latest
  vehicle::Grids grids = vehicle::Grids::kIndexes;
  // Where classes are among the grids, which need kHitsWin and kBlurring:
  pose::SourceDescription poses{};  // who says where the vehicle is
  map::SourceDescription maps{};    // who sends maps
  perception::Rules window{};       // how evidence becomes classes
  WindowConfig window_sides{};
  EvidenceConfig evidence{};  // of which the window's tables are made
  bool objects = true;        // things with a speed are followed (docs/objects.md)
};

}  // namespace iog::description
