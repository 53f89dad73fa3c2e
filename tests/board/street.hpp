// What the four LUX of vehicles/reference_car.toml and its pose source send on a straight street:
// the same bytes on every board. The car drives at 5 m/s between two walls 8 m to its sides, where
// a car is parked every 16 m.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "numeric/sine_table.hpp"
#include "pose/message.hpp"
#include "require/require.hpp"
#include "tools/formats/lux/lux_message.hpp"

namespace iog::tests {

inline constexpr std::uint64_t kFramePeriodUs = 40'000;

class Street {
 public:
  static constexpr std::uint32_t kSensors = 4;
  static constexpr std::uint32_t kMessages = 7;  // of a scan
  static constexpr std::uint32_t kPoses = 4;     // of a frame
  static constexpr std::uint64_t kPoseEveryUs = kFramePeriodUs / kPoses;

  // A message of the scan that this sensor makes in this frame, valid until the next call.
  std::span<const std::byte> scan(std::uint32_t frame, std::uint32_t sensor,
                                  std::uint32_t message) {
    const std::uint32_t first = message * kColumnsOfMessage;
    const std::uint32_t end =
        first + kColumnsOfMessage < kColumns ? first + kColumnsOfMessage : kColumns;
    std::array<std::uint16_t, kColumnsOfMessage> ranges_cm{};
    std::uint32_t returns = 0;
    for (std::uint32_t column = first; column < end; ++column) {
      ranges_cm[column - first] = range_cm(frame, kMounts[sensor], column);
      returns += ranges_cm[column - first] != 0 ? 1U : 0U;
    }
    wire::ByteWriter out(bytes_);
    const std::uint64_t begin_us = kBeginUs + frame * kFramePeriodUs;
    tools::write_lux_head({.device_id = static_cast<std::uint8_t>(sensor),
                           .scan_number = static_cast<std::uint16_t>(frame),
                           .start_ntp = ntp_of(begin_us),
                           .end_ntp = ntp_of(begin_us + kScanUs),
                           .start_ticks = angle_of(first),
                           .end_ticks = angle_of(end - 1)},
                          returns * kLayers, out);
    for (std::uint32_t column = first; column < end; ++column) {
      const std::uint16_t range = ranges_cm[column - first];
      for (std::uint8_t layer = 0; range != 0 && layer < kLayers; ++layer) {
        tools::write_lux_point({.layer = layer, .angle_ticks = angle_of(column), .range_cm = range},
                               out);
      }
    }
    require(out.ok());
    return out.written();
  }

  // The pose of a moment; the encoder numbers them.
  std::span<const std::byte> pose(std::uint32_t frame, std::uint32_t number) {
    const std::uint64_t since_us = frame * kFramePeriodUs + number * kPoseEveryUs;
    pose_ = encoder_.encode({.run = 1,
                             .age_us = 0,
                             .clock_us = kBeginUs + since_us,
                             .pose = {.x_mm = x_mm(since_us)},
                             .sigma = {.position_mm = 10, .heading_10urad = 10},
                             .speed_mm_per_s = kSpeedMmPerS});
    return pose_;
  }

 private:
  struct Mount {
    std::int32_t x_mm;
    std::int32_t y_mm;
    std::int32_t yaw;  // half degrees
  };
  static constexpr std::array<Mount, kSensors> kMounts{
      {{1950, 600, 80}, {2050, 0, 0}, {1950, -600, -80}, {-2050, 0, 360}}};
  static constexpr std::uint32_t kColumns = 201;          // of half a degree, from left to right
  static constexpr std::uint32_t kColumnsOfMessage = 33;  // 132 points: 1,388 bytes
  static constexpr std::uint32_t kLayers = 4;
  static constexpr std::uint64_t kScanUs = 1000;
  static constexpr std::int32_t kTicksOfColumn = 16;
  static constexpr std::int32_t kTurn = 720;  // half degrees
  static constexpr std::uint64_t kBeginUs = 1'700'000'000'000'000;
  static constexpr std::int32_t kSpeedMmPerS = 5000;
  static constexpr std::int32_t kWallMm = 8000;
  static constexpr std::int32_t kParkedMm = 6000;
  static constexpr std::int32_t kMostMm = 60'000;

  static std::int32_t x_mm(std::uint64_t since_us) {
    return static_cast<std::int32_t>(since_us / 1000) * kSpeedMmPerS / 1000;
  }
  static std::int16_t angle_of(std::uint32_t column) {
    return static_cast<std::int16_t>(kTicksOfColumn * (100 - static_cast<std::int32_t>(column)));
  }

  // Where the beam meets a wall or a parked car before it; 0: nothing within 60 m.
  static std::uint16_t range_cm(std::uint32_t frame, const Mount& mount, std::uint32_t column) {
    constexpr numeric::SineTable kHalfDegrees = numeric::kSineTable<kTurn>;
    const auto angle = static_cast<std::uint32_t>(
        (mount.yaw + 100 - static_cast<std::int32_t>(column) + 2 * kTurn) % kTurn);
    const std::int64_t sine = kHalfDegrees.sine(angle);
    const std::int64_t cosine = kHalfDegrees.cosine(angle);
    for (const std::int32_t side_mm : {kParkedMm, kWallMm}) {
      const std::int64_t across_mm = sine > 0 ? side_mm - mount.y_mm : side_mm + mount.y_mm;
      const std::int64_t steepness = sine > 0 ? sine : -sine;
      if (across_mm * kOne > kMostMm * steepness) {
        return 0;
      }
      const std::int64_t range_mm = across_mm * kOne / steepness;
      const std::int64_t along_mm =
          x_mm(frame * kFramePeriodUs) + mount.x_mm + range_mm * cosine / kOne + 1'000'000;
      if (side_mm == kWallMm || along_mm % 16'000 < 4500) {
        return static_cast<std::uint16_t>(range_mm / 10);
      }
    }
    return 0;
  }

  // NTP counts from 1900, in units of 2^-32 s.
  static std::uint64_t ntp_of(std::uint64_t unix_us) {
    const std::uint64_t seconds = unix_us / 1'000'000 + 2'208'988'800;
    return seconds << 32 | (unix_us % 1'000'000 << 32) / 1'000'000;
  }

  static constexpr std::int64_t kOne = std::int64_t{1} << numeric::kSineFractionBits;

  std::array<std::byte, tools::kMaxLuxDatagramBytes> bytes_{};
  pose::Encoder encoder_;
  std::array<std::byte, pose::kMessageBytes> pose_{};
};

}  // namespace iog::tests
