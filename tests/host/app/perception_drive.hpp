// A car that drives straight on along a wall, with the poses that it says of itself: datagrams for
// tests of the perception engine, made of plain numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "fakes/lux_message.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "pose/message.hpp"

namespace iog::app::testing {

inline constexpr std::uint64_t kStartUs = 1'714'564'800'000'000;  // 2024-05-01 12:00 UTC
inline constexpr std::uint64_t kPeriodUs = 40'000;
inline constexpr std::uint64_t kSweepUs = 10'000;
inline constexpr std::uint64_t kPoseAgeUs = 2'000;
inline constexpr double kSpeedMps = 10;
inline constexpr std::uint32_t kReplayer = 0x0A000202;

struct TimedDatagram {
  std::uint64_t now_us = 0;  // when it arrives, by the target's clock, which is 0 at kStartUs
  std::uint16_t port = 0;
  std::vector<std::byte> bytes;
};

// A vehicle whose sensors all have clocks as the poses have, or all come so late.
class Car {
 public:
  Car(const vehicle::Vehicle& like, bool is_synchronised, std::uint32_t latency_us = 0)
      : sensors_(like.sensors.begin(), like.sensors.end()), vehicle_(like) {
    for (vehicle::Sensor& sensor : sensors_) {
      sensor.is_synchronised = is_synchronised;
      sensor.latency_us = latency_us;
    }
    vehicle_.sensors = sensors_;
  }
  Car(const Car&) = delete;
  Car& operator=(const Car&) = delete;
  [[nodiscard]] const vehicle::Vehicle& vehicle() const { return vehicle_; }

 private:
  std::vector<vehicle::Sensor> sensors_;
  vehicle::Vehicle vehicle_;
};

inline std::uint64_t ntp_of(std::uint64_t unix_us) {
  return (unix_us / 1'000'000 + 2'208'988'800U) << 32 | ((unix_us % 1'000'000) << 32) / 1'000'000;
}

// Where the car is: time since kStartUs to metres along x.
inline double x_at(double time_us) { return kSpeedMps * time_us / 1e6; }

inline pose::Message pose_at(std::uint64_t time_us, std::uint32_t run = 1) {
  return {.run = run,
          .age_us = kPoseAgeUs,
          .clock_us = kStartUs + time_us,
          .pose = {.x_mm = static_cast<std::int32_t>(
                       std::llround(1000 * x_at(static_cast<double>(time_us)))),
                   .y_mm = 0,
                   .heading = 0},
          .sigma = {10, 10},
          .speed_mm_per_s = static_cast<std::int32_t>(1000 * kSpeedMps)};
}

inline TimedDatagram datagram_of(const pose::Message& message) {
  pose::Encoder encoder;
  const auto encoded = encoder.encode(message);
  return {.now_us = message.clock_us - kStartUs + message.age_us,
          .port = pose::kPosePort,
          .bytes = {encoded.begin(), encoded.end()}};
}

// Poses every 10 ms, those measured from begin_us up to before end_us.
inline std::vector<TimedDatagram> poses(std::uint64_t begin_us, std::uint64_t end_us,
                                        std::uint32_t run = 1) {
  std::vector<TimedDatagram> datagrams;
  for (std::uint64_t time_us = begin_us; time_us < end_us; time_us += 10'000) {
    datagrams.push_back(datagram_of(pose_at(time_us, run)));
  }
  return datagrams;
}

// A scan of a LUX in the middle of the car which ends at end_us, in `parts` messages. Each beam
// meets a wall across the road at that x, measured when it is sent, or is lost.
inline std::vector<TimedDatagram> scan_of_wall(std::uint16_t port, int number, int parts,
                                               std::uint64_t end_us, double wall_m) {
  std::vector<TimedDatagram> datagrams;
  const std::uint64_t begin_us = end_us - kSweepUs;
  for (int part = 0; part < parts; ++part) {
    const int left = 1600 - 3200 * part / parts;
    const int right = 1600 - 3200 * (part + 1) / parts;
    tests::LuxMessage message{.scan_number = number,
                              .start_ticks = left,
                              .end_ticks = right,
                              .points = {},
                              .start_ntp = ntp_of(kStartUs + begin_us),
                              .end_ntp = ntp_of(kStartUs + end_us)};
    for (int ticks = left; ticks > right; ticks -= 16) {
      const double share = (1600 - ticks) / 3200.0;
      const double x = x_at(static_cast<double>(begin_us) + share * kSweepUs);
      const double range = (wall_m - x) / std::cos(ticks * 2 * std::numbers::pi / 11520);
      if (range > 0.5 && range < 49) {
        message.points.push_back({.layer = 2,
                                  .angle_ticks = ticks,
                                  .range_cm = static_cast<int>(std::llround(100 * range))});
      }
    }
    datagrams.push_back({end_us, port, message.bytes()});
  }
  return datagrams;
}

}  // namespace iog::app::testing
