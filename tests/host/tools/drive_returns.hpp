// The returns of packets of the car with an HDL-64E S3, and the points that they are.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "lidar/velodyne_hdl64e.hpp"
#include "tools/clouds/point_cloud.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/poses/pose_sample.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

inline constexpr double kTurnUs = 100'000;
inline constexpr double kBlockUs = 57.6;

inline const CatalogueEntry& car() { return find_vehicle("roof_hdl64e"); }

// A return as the wire has it.
struct Return {
  std::size_t layer = 0;
  double time_us = 0;  // of the drive
  std::uint32_t range_mm = 0;
  std::int32_t azimuth_ticks = 0;  // counter-clockwise, where the head looked
};

inline std::vector<Return> returns_of(const std::vector<CapturedDatagram>& datagrams) {
  std::vector<Return> returns;
  lidar::VelodyneHdl64eS3 decoder;
  for (const CapturedDatagram& datagram : datagrams) {
    if (datagram.destination.port != car().sensors[0].udp_port) {
      continue;
    }
    EXPECT_EQ(decoder.decode(datagram.payload), lidar::DecodeStatus::kOk);
    const auto begin_us = static_cast<double>(decoder.info().sweep.begin_us);  // of a full hour
    std::size_t i = 0;
    decoder.for_each_point([&](const lidar::ScanPoint& point) {
      const std::size_t firing = i / 64;
      const std::size_t channel = i++ % 32;
      if (point.range_mm > 0) {
        returns.push_back({.layer = point.layer,
                           .time_us = begin_us + static_cast<double>(firing) * kBlockUs +
                                      kBlockUs * lidar::kHdl64eS3Unit.fires_at[channel] / 240,
                           .range_mm = point.range_mm,
                           .azimuth_ticks = point.azimuth_ticks});
      }
    });
  }
  return returns;
}

inline std::size_t turn_of(const Return& its) {
  return static_cast<std::size_t>(std::lround(its.time_us / kTurnUs)) - 1;
}

// In the frame of the unit, by docs/sensors.md: the beam leaves the axis at a height that its laser
// says, and the wire's range begins elsewhere by a correction.
inline CloudPoint point_of(const Return& its) {
  const lidar::Laser& laser = car().sensors[0].lasers[its.layer];
  const double elevation = laser.elevation_deg * kRadians;
  const double azimuth = (its.azimuth_ticks / 100.0 + laser.azimuth_deg) * kRadians;
  const double way = its.range_mm / 1000.0 + laser.range_m - laser.height_m * std::tan(elevation);
  const double r = way * std::cos(elevation);
  return {r * std::cos(azimuth), r * std::sin(azimuth),
          laser.height_m / std::cos(elevation) + way * std::sin(elevation)};
}

}  // namespace iog::tools
