// The beams that every contender gets: those of simulated frames, as scan points and in metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "geometry/grid.hpp"
#include "lidar/scan_point.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

struct PointMetres {
  double x = 0;  // in the vehicle frame; the grid covers [-51.2, 51.2) of both axes
  double y = 0;
};

struct PeerBeam {
  std::size_t sensor;  // place in Vehicle::sensors
  lidar::ScanPoint point;
  PointMetres origin;
  PointMetres end;  // where the evidence ends, or the scan point if it is too far to mark
  bool is_too_far;  // carves as far as the sensor's range
  bool marks;
};

// In the order of arrival.
using PeerFrame = std::vector<PeerBeam>;

struct PeerFrames {
  const vehicle::Vehicle* vehicle;
  std::vector<PeerFrame> frames;
  std::size_t beams = 0;
  // Beams that carve up to the ground or to the height band's end. The libraries cannot be told of
  // them: they mark their ends.
  std::size_t only_carving = 0;
  std::size_t later_echoes = 0;  // nobody gets them: MRPT's scans have one range a direction
};

inline constexpr double kCellM = geometry::kCellMm / 1000.0;
inline constexpr double kHalfSideM = geometry::kOriginCell * kCellM;

// Every `step`-th frame of a drive, from its first.
[[nodiscard]] PeerFrames frames_of(const tools::CatalogueEntry& car, std::string_view scene,
                                   std::uint64_t seed, std::uint32_t seconds, std::uint32_t step);

}  // namespace iog::lab
