// What a frame says of itself: which sensors took part, what became of the scan points, and what it
// cost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/thermometer.hpp"
#include "intake/sensor_report.hpp"
#include "stream/message.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

// How the platform is.
struct Vitals {
  std::uint32_t stack_used_bytes = 0;  // deepest so far
  std::uint32_t link_drops = 0;        // datagrams that the link itself has dropped, since start
  std::int16_t temperature_dc = hal::kTemperatureNotKnown;  // of the chip, 1/10 degree Celsius
  std::size_t link_counter_count = 0;
  std::array<std::uint32_t, stream::kMaxLinkCounters>
      link_counters{};  // since start, as docs/spec.md
};

// What a frame has taken.
struct FrameTimes {
  stream::StageTicks ticks{};  // publish: that of the frame before
  std::uint32_t late_us = 0;   // how long after its deadline it was closed
  bool has_packets = false;
};

struct FrameReport {
  std::uint32_t run_number = 0;
  std::uint32_t number = 0;     // wraps
  std::uint64_t opened_us = 0;  // by the target's clock
  std::uint64_t closed_us = 0;
  bool is_timed_out = false;     // closed by time, not by its sensors
  std::uint32_t vehicle_id = 0;  // Vehicle::id
  vehicle::FusionRule rule = vehicle::FusionRule::kHitsWin;
  vehicle::Grids grids = vehicle::Grids::kIndexes;  // that its vehicle asks for
  bool has_objects = false;                         // likewise
  bool has_receptions = false;                      // likewise

  std::size_t sensor_count = 0;
  // Sectors around the vehicle (intake/watched_sectors.hpp).
  std::uint64_t unwatched = 0;
  std::uint64_t blocked = 0;
  std::array<intake::SensorReport, vehicle::kMaxSensors> sensors{};
  std::uint32_t packets_fused = 0;                                     // of this frame
  std::uint32_t packets_dropped = 0;                                   // since start
  std::array<std::uint32_t, intake::kPacketDropCount> packet_drops{};  // since start, by cause
  std::array<std::uint32_t, vehicle::kFateCount> fates{};              // scan points of this frame

  stream::StageTicks ticks{};  // publish: that of the frame before
  std::uint32_t ticks_hz = 0;
  Vitals vitals{};
};

}  // namespace iog::app
