#include "tools/formats/lux/lux_scan.hpp"

#include <algorithm>
#include <utility>

#include "gtest/gtest.h"

#include "lidar/ibeo_lux.hpp"
#include "tools/formats/lux/lux_stream.hpp"
#include "tools/formats/lux/ntp_time.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

// Points in wild order: `per_azimuth` of them every `step` ticks.
LuxScan scan_of(int per_azimuth, int step) {
  LuxScan scan;
  scan.scan_number = 4711;
  scan.mounting = {1, -2, 3, -4, 5, -6};
  std::uint16_t range_cm = 100;
  for (int pass = 0; pass < per_azimuth; ++pass) {
    for (int angle = -1600; angle <= 1600; angle += step) {
      scan.points.push_back({.layer = static_cast<std::uint8_t>(pass % 4),
                             .echo = static_cast<std::uint8_t>(pass / 4 % 3),
                             .flags = static_cast<std::uint8_t>(range_cm & 0x0F),
                             .angle_ticks = static_cast<std::int16_t>(angle),
                             .range_cm = range_cm++,
                             .pulse_width_cm = 40,
                             .reserved = 7});
    }
  }
  return scan;
}

bool is_before(const LuxPoint& a, const LuxPoint& b) { return a.range_cm < b.range_cm; }

std::vector<LuxPoint> points_in(const std::vector<std::vector<std::byte>>& messages) {
  std::vector<LuxPoint> points;
  for (const auto& message : messages) {
    const LuxScan part = parse_lux_message(message);
    points.insert(points.end(), part.points.begin(), part.points.end());
  }
  return points;
}

TEST(LuxScan, SplittingKeepsEveryPoint) {
  for (const auto& [per_azimuth, step] :
       {std::pair{1, 16}, {4, 16}, {12, 16}, {12, 8}, {3, 3200}}) {
    const LuxScan scan = scan_of(per_azimuth, step);
    std::vector<LuxPoint> points = points_in(split_lux_scan(scan));
    std::ranges::sort(points, is_before);
    EXPECT_EQ(points, scan.points);
  }
}

TEST(LuxScan, MessagesFitAndTheirSectorsFollowOneAnother) {
  const auto messages = split_lux_scan(scan_of(12, 16));
  ASSERT_GT(messages.size(), 10U);
  std::int16_t expected_start = 1600;
  for (const auto& message : messages) {
    EXPECT_LE(message.size(), kMaxLuxDatagramBytes);
    const LuxScan part = parse_lux_message(message);
    EXPECT_EQ(part.start_ticks, expected_start);
    EXPECT_LT(part.end_ticks, part.start_ticks);
    EXPECT_EQ(part.scan_number, 4711);
    EXPECT_EQ(part.mounting, scan_of(1, 16).mounting);
    // The azimuth on the border belongs to the message before.
    EXPECT_TRUE(expected_start == 1600 || part.points.front().angle_ticks < part.start_ticks);
    EXPECT_EQ(part.points.size() % 12, 0U);
    expected_start = part.end_ticks;
  }
  EXPECT_EQ(expected_start, -1600);
}

TEST(LuxScan, AScanWithoutPointsIsOneMessageOfTheWholeSector) {
  const auto messages = split_lux_scan(LuxScan{});
  ASSERT_EQ(messages.size(), 1U);
  lidar::IbeoLux decoder;
  ASSERT_EQ(decoder.decode(messages[0]), lidar::DecodeStatus::kOk);
  EXPECT_EQ(decoder.info().sector.width_ticks, 3200);
  EXPECT_EQ(decoder.info().point_count, 0U);
}

TEST(LuxScan, AMirrorThatTurnsTheOtherWayIsKept) {
  LuxScan scan = scan_of(4, 16);
  std::swap(scan.start_ticks, scan.end_ticks);
  std::int16_t expected_start = -1600;
  for (const auto& message : split_lux_scan(scan)) {
    const LuxScan part = parse_lux_message(message);
    EXPECT_EQ(part.start_ticks, expected_start);
    expected_start = part.end_ticks;
  }
  EXPECT_EQ(expected_start, 1600);
}

// More points of one azimuth than a message holds: it is cut within the azimuth.
TEST(LuxScan, EvenOneAzimuthIsCutWhereItMust) {
  LuxScan scan;
  scan.points.assign(300, LuxPoint{.angle_ticks = 8, .range_cm = 5});
  const auto messages = split_lux_scan(scan);
  EXPECT_EQ(messages.size(), 3U);
  EXPECT_EQ(points_in(messages).size(), 300U);
}

TEST(LuxStream, FindsScansBetweenOtherBytes) {
  const std::vector<std::byte> scan = split_lux_scan(scan_of(1, 16), 100'000).at(0);
  std::vector<std::byte> other = scan;
  other[14] = std::byte{0x22};
  other[15] = std::byte{0x21};  // an object list
  std::vector<std::byte> bytes(5, std::byte{0xAF});
  for (const auto* part : {&scan, &std::as_const(other), &scan}) {
    bytes.insert(bytes.end(), part->begin(), part->end());
  }
  bytes.insert(bytes.end(), scan.begin(), scan.begin() + 50);
  const LuxStream stream = read_lux_stream(bytes);
  EXPECT_EQ(stream.scans.size(), 2U);
  EXPECT_EQ(stream.other_messages, 1U);
  EXPECT_EQ(stream.skipped_bytes, 55U);
}

TEST(LuxStream, ARecordingThatEndsAnywhereInAMessageIsSkippedFromThere) {
  const std::vector<std::byte> scan = split_lux_scan(scan_of(0, 16), 100'000).at(0);
  for (std::size_t size = 0; size < scan.size(); ++size) {
    const std::vector<std::byte> cut(scan.begin(),
                                     scan.begin() + static_cast<std::ptrdiff_t>(size));
    const LuxStream stream = read_lux_stream(cut);
    ASSERT_EQ(stream.skipped_bytes, size);
    ASSERT_EQ(stream.scans.size() + stream.other_messages + stream.malformed, 0U);
  }
}

TEST(LuxStream, AMessageThatContradictsItselfIsCounted) {
  auto message = split_lux_scan(scan_of(1, 16), 100'000)[0];
  message[lidar::IbeoLux::kHeaderBytes + 28] ^= std::byte{1};  // number of points
  EXPECT_THROW(static_cast<void>(parse_lux_message(message)), UsageError);
  EXPECT_EQ(read_lux_stream(message).malformed, 1U);
}

TEST(NtpTime, GoesThereAndBack) {
  constexpr std::uint64_t kTime = 1'714'564'800'123'456U;
  EXPECT_EQ(ntp_of_unix_us(0) >> 32, 2'208'988'800U);  // RFC 868
  EXPECT_NEAR(static_cast<double>(unix_us_of_ntp(ntp_of_unix_us(kTime)) - (kTime - 1)), 1, 1);
}

}  // namespace
}  // namespace iog::tools
