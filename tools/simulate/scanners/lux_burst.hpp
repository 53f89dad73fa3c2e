// How a car's LUX send a frame: their scans on the wire, whatever is in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

inline constexpr std::uint32_t kLuxFramesPerSecond = 25;

inline constexpr std::uint64_t kLuxPeriodUs = 1'000'000 / kLuxFramesPerSecond;
inline constexpr std::uint64_t kLuxBurstGapUs = 70;   // from one datagram to the next
inline constexpr std::uint64_t kLuxSweepUs = 11'111;  // 100 degrees at 25 Hz

// The points of that sensor's scan.
using ScanOfSensor = std::function<std::vector<LuxPoint>(std::size_t sensor)>;

// Which scan it is, and when its last beam was sent.
struct LuxScanTime {
  std::size_t sensor = 0;    // among the car's LUX
  std::uint32_t frame = 0;   // the scan's number less one
  std::uint64_t end_us = 0;  // since 1970-01-01 UTC

  [[nodiscard]] constexpr std::uint32_t number() const { return frame + 1; }
};

// Appends the datagrams of one scan. A unit of eight layers says by which side of its mirror. The
// first leaves at that time, the others 70 us apart.
void append_lux_scan(const description::SensorConfig& config, const LuxScanTime& time,
                     std::vector<LuxPoint> points, std::uint64_t first_sent_us,
                     std::vector<CapturedDatagram>& datagrams);

// The datagrams of frame 0, 1, ..., in the order of their times: one burst of all sensors, one
// after another, which begins at the end of their scans. All sensors of the car are LUX.
[[nodiscard]] std::vector<CapturedDatagram> lux_burst(const CatalogueEntry& car,
                                                      std::uint32_t frame,
                                                      const ScanOfSensor& points_of);

}  // namespace iog::tools
