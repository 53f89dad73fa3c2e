#include "intake/measurement_time.hpp"

#include <algorithm>

namespace iog::intake {
namespace {

constexpr std::uint64_t kHourUs = 3'600'000'000U;

std::uint64_t duration_of(const lidar::Sweep& sweep) {
  constexpr std::uint64_t kLongestUs = 1'000'000;
  return sweep.end_us < sweep.begin_us ? 0 : std::min(sweep.end_us - sweep.begin_us, kLongestUs);
}

// The middle of the message's sector, as a share of the scan. Angles are doubled to keep the middle
// a whole number. They are below 2^18, and times a second below 2^38.
std::uint64_t lux_middle_us(const vehicle::Sensor& sensor, const lidar::PacketInfo& packet) {
  const auto turn = static_cast<std::int32_t>(sensor.azimuths.ticks_per_turn());
  const std::int32_t first = packet.sector.first_ticks;
  const std::int32_t right = first >= turn / 2 ? first - turn : first;
  const std::int32_t middle = 2 * right + packet.sector.width_ticks;
  const std::int32_t width = sensor.scan_width_ticks;
  const std::int32_t swept =
      std::clamp<std::int32_t>(width + (packet.sweep.turns_right ? -middle : middle), 0, 2 * width);
  const std::uint64_t whole = 2 * static_cast<std::uint64_t>(width);
  return packet.sweep.begin_us +
         (duration_of(packet.sweep) * static_cast<std::uint64_t>(swept) + whole / 2) / whole;
}

// The time nearest to near_us that is this long after a full hour.
std::uint64_t completed(std::uint64_t since_hour_us, std::uint64_t near_us) {
  const std::uint64_t time_us = near_us - near_us % kHourUs + since_hour_us;
  if (time_us > near_us + kHourUs / 2 && time_us >= kHourUs) {
    return time_us - kHourUs;
  }
  return time_us + kHourUs / 2 < near_us ? time_us + kHourUs : time_us;
}

}  // namespace

std::uint64_t measured_us(const vehicle::Sensor& sensor, const lidar::PacketInfo& packet,
                          std::uint64_t near_us) {
  if (!packet.sweep.is_of_packet) {
    return lux_middle_us(sensor, packet);
  }
  const std::uint64_t middle_us = packet.sweep.begin_us + duration_of(packet.sweep) / 2;
  return packet.sweep.is_of_hour ? completed(middle_us % kHourUs, near_us) : middle_us;
}

}  // namespace iog::intake
