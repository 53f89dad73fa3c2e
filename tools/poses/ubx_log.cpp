#include <algorithm>
#include <cmath>

#include "tools/poses/local_plane.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/poses/text_fields.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools {
namespace {

constexpr std::uint16_t kSync = 0xB562;
constexpr std::uint16_t kNavPvt = 0x0107;  // class and id
constexpr std::size_t kNavPvtBytes = 92;
constexpr std::size_t kHeaderBytes = 6;
constexpr std::size_t kChecksumBytes = 2;

// The message at the beginning of the bytes, from its synchronisation to its checksum; empty if
// there is none.
std::span<const std::byte> message_at(std::span<const std::byte> bytes) {
  wire::ByteReader in(bytes);
  const std::uint16_t sync = in.u16_be();
  in.skip(2);
  const std::size_t payload_bytes = in.u16_le();
  if (!in.ok() || sync != kSync || in.remaining() < payload_bytes + kChecksumBytes) {
    return {};
  }
  std::uint8_t a = 0;
  std::uint8_t b = 0;
  for (const std::byte byte : bytes.subspan(2, kHeaderBytes - 2 + payload_bytes)) {
    a = static_cast<std::uint8_t>(a + static_cast<std::uint8_t>(byte));
    b = static_cast<std::uint8_t>(b + a);
  }
  in.skip(payload_bytes);
  return in.u8() == a && in.u8() == b ? bytes.first(kHeaderBytes + payload_bytes + kChecksumBytes)
                                      : std::span<const std::byte>();
}

struct Pvt {
  std::optional<std::uint64_t> time_us;
  bool has_fix = false;
  double latitude = 0;
  double longitude = 0;
  double north_mps = 0;
  double east_mps = 0;
  double heading_deg = 0;
  double sigma_mps = 0;
  double sigma_heading_deg = 0;
};

std::optional<std::uint64_t> time_in(wire::ByteReader& in) {
  const std::uint32_t year = in.u16_le();
  const std::uint32_t month = in.u8();
  const std::uint32_t day = in.u8();
  const std::uint64_t hour = in.u8();
  const std::uint64_t minute = in.u8();
  const std::uint64_t second = in.u8();
  const std::uint8_t valid = in.u8();
  in.skip(4);  // accuracy of the time
  const std::int32_t nanoseconds = in.i32_le();
  if ((valid & 3) != 3 || hour > 23 || minute > 59 || second > 60 ||
      std::abs(nanoseconds) >= 1'000'000'000) {
    return std::nullopt;
  }
  const auto midnight = unix_us_of(year, month, day, 0);
  if (!midnight) {
    return std::nullopt;
  }
  // The fraction may be a little before the second.
  const std::uint64_t second_us = ((hour * 60 + minute) * 60 + second) * 1'000'000;
  const auto fraction_us = static_cast<std::int64_t>(std::floor(nanoseconds / 1000.0));
  return *midnight + second_us + static_cast<std::uint64_t>(fraction_us);
}

Pvt pvt_in(std::span<const std::byte> payload) {
  constexpr double kAngle = 1e-7;
  constexpr double kCourse = 1e-5;
  wire::ByteReader in(payload);
  Pvt pvt;
  in.skip(4);
  pvt.time_us = time_in(in);
  const std::uint8_t fix = in.u8();
  const std::uint8_t flags = in.u8();
  pvt.has_fix = (flags & 1) != 0 && fix >= 2 && fix <= 4;  // 2D, 3D, with dead reckoning
  in.skip(2);
  pvt.longitude = in.i32_le() * kAngle;
  pvt.latitude = in.i32_le() * kAngle;
  in.skip(16);  // heights, their and the position's accuracy
  pvt.north_mps = in.i32_le() / 1000.0;
  pvt.east_mps = in.i32_le() / 1000.0;
  in.skip(8);
  const double course_deg = in.i32_le() * kCourse;
  pvt.sigma_mps = in.u32_le() / 1000.0;
  pvt.sigma_heading_deg = in.u32_le() * kCourse;
  in.skip(8);
  const double vehicle_deg = in.i32_le() * kCourse;
  pvt.heading_deg = (flags & 0x20) != 0 ? vehicle_deg : course_deg;
  return pvt;
}

LoggedPose pose_of(const Pvt& pvt, const LocalPlane& plane) {
  const LocalPlane::Place place = plane.place_of(pvt.latitude, pvt.longitude);
  const double heading = (90 - pvt.heading_deg) * kRadians;
  return {.time_us = *pvt.time_us,
          .x_m = place.east_m,
          .y_m = place.north_m,
          .heading_rad = heading,
          .speed_mps = pvt.east_mps * std::cos(heading) + pvt.north_mps * std::sin(heading),
          .yaw_rate_rps = std::nullopt,
          // The error of the speed is that of the way in a second.
          .sigma_m = pvt.sigma_mps,
          .sigma_heading_rad = pvt.sigma_heading_deg * kRadians};
}

}  // namespace

PoseLog read_ubx_log(std::span<const std::byte> bytes) {
  std::size_t skipped = 0;
  std::size_t others = 0;
  std::size_t without_fix = 0;
  PoseLog log;
  while (!bytes.empty()) {
    const std::span<const std::byte> message = message_at(bytes);
    if (message.empty()) {
      ++skipped;
      bytes = bytes.subspan(1);
      continue;
    }
    bytes = bytes.subspan(message.size());
    const auto payload =
        message.subspan(kHeaderBytes, message.size() - kHeaderBytes - kChecksumBytes);
    if (wire::load_be16(message.subspan<2, 2>()) != kNavPvt || payload.size() != kNavPvtBytes) {
      ++others;
      continue;
    }
    const Pvt pvt = pvt_in(payload);
    const bool is_on_earth = std::abs(pvt.latitude) <= 90 && std::abs(pvt.longitude) <= 180;
    if (!pvt.time_us || !pvt.has_fix || !is_on_earth) {
      ++without_fix;
      continue;
    }
    if (!log.plane) {
      log.plane.emplace(pvt.latitude, pvt.longitude);
    }
    log.poses.push_back(pose_of(pvt, *log.plane));
  }
  remark(skipped, "bytes that are no UBX message", log.remarks);
  remark(others, "messages other than NAV-PVT", log.remarks);
  remark(without_fix, "NAV-PVT without a fix or a time", log.remarks);
  return log;
}

}  // namespace iog::tools
