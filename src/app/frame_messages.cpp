#include "app/frame_messages.hpp"

#include <numeric>

namespace iog::app {
namespace {

// Bit i: sensor i is in this state.
std::uint8_t sensors_in_state(const FrameReport& report, intake::SensorState state) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < report.sensor_count; ++i) {
    bits |= report.sensors[i].state == state ? 1U << i : 0U;
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

stream::Header header_of(const FrameReport& report) {
  const std::uint32_t used = report.fates[static_cast<std::size_t>(vehicle::Fate::kUsed)];
  const std::uint32_t points = std::accumulate(report.fates.begin(), report.fates.end(), 0U);
  const unsigned timed_out = report.is_timed_out ? stream::kFlagTimedOut : 0U;
  const unsigned bayes = report.rule == vehicle::FusionRule::kBayes ? stream::kFlagBayes : 0U;
  return {.flags = static_cast<std::uint8_t>(timed_out | bayes),
          .frame_number = report.number,
          .closed_us = report.closed_us,
          .vehicle_id = report.vehicle_id,
          .sensor_count = static_cast<std::uint8_t>(report.sensor_count),
          .complete_sensors = sensors_in_state(report, intake::SensorState::kComplete),
          .partial_sensors = sensors_in_state(report, intake::SensorState::kPartial),
          .points_used = used,
          .points_other = points - used,
          .packets_fused = report.packets_fused,
          .packets_dropped = report.packets_dropped + report.vitals.link_drops,
          .run_number = report.run_number};
}

void set_frame_end(const FrameReport& report, stream::FrameEnd& end) {
  end = {.opened_us = report.opened_us,
         .stopwatch_hz = report.ticks_hz,
         .ticks = report.ticks,
         .stack_used_bytes = report.vitals.stack_used_bytes,
         .fates = report.fates,
         .packet_drops = report.packet_drops,
         .link_counter_count = static_cast<std::uint8_t>(report.vitals.link_counter_count),
         .link_counters = report.vitals.link_counters,
         .sensors = report.sensors,
         .unwatched = report.unwatched,
         .blocked = report.blocked,
         .temperature_dc = report.vitals.temperature_dc};
}

}  // namespace iog::app
