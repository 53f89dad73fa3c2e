#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/poses/pose_log.hpp"
#include "tools/poses/receiver_fixes.hpp"
#include "tools/poses/text_fields.hpp"
#include "wire/byte_reader.hpp"

namespace iog::tools {
namespace {

constexpr std::uint16_t kSync = 0xB562;
constexpr std::uint16_t kNavPvt = 0x0107;  // class and id
// Of receivers before the M8: without the heading of the vehicle. Later ones may append fields.
constexpr std::size_t kLeastPvtBytes = 84;
constexpr std::size_t kVehiclePvtBytes = 92;
// RXM-RAWX with 255 measurements is the longest message. Without this limit, the checksum of a
// false longer message could be computed at every byte.
constexpr std::size_t kMostPayloadBytes = 8'176;
constexpr std::size_t kHeaderBytes = 6;
constexpr std::size_t kChecksumBytes = 2;

}  // namespace

std::span<const std::byte> ubx_message_at(std::span<const std::byte> bytes) {
  wire::ByteReader in(bytes);
  const std::uint16_t sync = in.u16_be();
  in.skip(2);
  const std::size_t payload_bytes = in.u16_le();
  if (!in.ok() || sync != kSync || payload_bytes > kMostPayloadBytes ||
      in.remaining() < payload_bytes + kChecksumBytes) {
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

namespace {

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

// Empty without a fix, a time or a place on earth.
std::optional<Fix> fix_in(std::span<const std::byte> payload) {
  constexpr double kAngle = 1e-7;
  constexpr double kCourse = 1e-5;
  wire::ByteReader in(payload);
  in.skip(4);
  const std::optional<std::uint64_t> time_us = time_in(in);
  const std::uint8_t kind = in.u8();
  const std::uint8_t flags = in.u8();
  in.skip(2);
  const double longitude = in.i32_le() * kAngle;
  const double latitude = in.i32_le() * kAngle;
  in.skip(16);  // heights, their and the position's accuracy
  const double north_mps = in.i32_le() / 1000.0;
  const double east_mps = in.i32_le() / 1000.0;
  in.skip(8);
  const double course_deg = in.i32_le() * kCourse;
  // The error of the speed is that of the way in a second.
  const double sigma_mps = in.u32_le() / 1000.0;
  const double sigma_heading_deg = in.u32_le() * kCourse;
  in.skip(8);
  // 2D, 3D, with dead reckoning
  const bool has_fix = (flags & 1) != 0 && kind >= 2 && kind <= 4;
  if (!time_us || !has_fix || std::abs(latitude) > 90 || std::abs(longitude) > 180) {
    return std::nullopt;
  }
  Fix fix{.time_us = *time_us,
          .at = {latitude, longitude},
          .speed_mps = std::hypot(north_mps, east_mps),
          .course_deg = course_deg,
          .sigma_m = sigma_mps,
          .sigma_heading_rad = sigma_heading_deg * kRadians};
  if (payload.size() >= kVehiclePvtBytes && (flags & 0x20) != 0) {
    fix.heading_deg = in.i32_le() * kCourse;
  }
  return fix;
}

}  // namespace

PoseLog read_ubx_log(std::span<const std::byte> bytes) {
  std::size_t skipped = 0;
  std::size_t others = 0;
  Tally without_fix;
  std::vector<Fix> fixes;
  for (std::size_t number = 1; !bytes.empty();) {
    const std::span<const std::byte> message = ubx_message_at(bytes);
    if (message.empty()) {
      ++skipped;
      bytes = bytes.subspan(1);
      continue;
    }
    bytes = bytes.subspan(message.size());
    const auto payload =
        message.subspan(kHeaderBytes, message.size() - kHeaderBytes - kChecksumBytes);
    if (wire::load_be16(message.subspan<2, 2>()) != kNavPvt || payload.size() < kLeastPvtBytes) {
      ++others;
      continue;
    }
    std::optional<Fix> fix = fix_in(payload);
    if (fix) {
      fix->place = number;
      fixes.push_back(*fix);
    } else {
      without_fix.add(number);
    }
    ++number;
  }
  PoseLog log = log_of(std::move(fixes), "NAV-PVT");
  remark(skipped, "byte|bytes that is|are no UBX message", log.remarks);
  remark(others, "message|messages other than NAV-PVT", log.remarks);
  remark(without_fix, "NAV-PVT without a fix or a time", log.unit, log.remarks);
  return log;
}

}  // namespace iog::tools
