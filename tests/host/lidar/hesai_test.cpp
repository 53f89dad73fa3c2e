#include "lidar/hesai.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/hesai_packet.hpp"
#include "fakes/real_packets.hpp"

namespace iog::lidar {
namespace {

using Sent = tests::HesaiPacket;

// A packet, decoded as one of that unit.
struct Decoded {
  Decoded(const std::vector<std::byte>& bytes, bool is_xt32,
          std::span<const LaserCorrection> corrections = {}) {
    if (is_xt32) {
      decode<HesaiXt32>(bytes, corrections);
    } else {
      decode<HesaiPandar64>(bytes, corrections);
    }
  }
  DecodeStatus status{};
  PacketInfo info;
  std::vector<ScanPoint> points;

 private:
  template <typename Decoder>
  void decode(const std::vector<std::byte>& bytes, std::span<const LaserCorrection> corrections) {
    Decoder decoder;
    status = decoder.decode(bytes, corrections);
    info = decoder.info();
    if (status == DecodeStatus::kOk) {
      decoder.for_each_point([&](const ScanPoint& point) { points.push_back(point); });
    }
  }
};

DecodeStatus decode(const std::vector<std::byte>& bytes, bool is_xt32) {
  return Decoded(bytes, is_xt32).status;
}

// User manuals: 1194 bytes, 1198 with a sequence number; 1080.
TEST(Hesai, PacketsAreAsLongAsTheManualsSay) {
  EXPECT_EQ(Sent{}.bytes().size(), 1198U);
  EXPECT_EQ(Sent{.has_sequence = false}.bytes().size(), 1194U);
  EXPECT_EQ(Sent{.is_xt32 = true}.bytes().size(), 1080U);
  for (const bool is_xt32 : {false, true}) {
    auto bytes = Sent{.is_xt32 = is_xt32}.bytes();
    EXPECT_EQ(decode(bytes, is_xt32), DecodeStatus::kOk);
    EXPECT_EQ(decode(bytes, !is_xt32), DecodeStatus::kWrongLength);
    bytes.pop_back();
    EXPECT_EQ(decode(bytes, is_xt32), DecodeStatus::kWrongLength);
    EXPECT_EQ(decode({}, is_xt32), DecodeStatus::kWrongLength);
  }
  EXPECT_EQ(decode(Sent{.has_sequence = false}.bytes(), false), DecodeStatus::kOk);
}

TEST(Hesai, TurnsUnitsIntoPoints) {
  for (const bool is_xt32 : {false, true}) {
    const std::size_t lasers = is_xt32 ? 32 : 64;
    Sent sent{.is_xt32 = is_xt32, .first_azimuth = 9000};
    sent.ranges[0][0] = 2500;
    sent.ranges[5][lasers - 1] = 0xFFFF;
    std::vector<LaserCorrection> lasers_of_unit(lasers);
    lasers_of_unit[0] = {.azimuth_ticks = -521, .range_mm = 30};
    lasers_of_unit[lasers - 1] = {.azimuth_ticks = 27'000, .range_mm = 0};
    const Decoded packet(sent.bytes(), is_xt32, lasers_of_unit);
    ASSERT_EQ(packet.status, DecodeStatus::kOk);
    const auto& points = packet.points;
    ASSERT_EQ(points.size(), (is_xt32 ? 8U : 6U) * lasers);
    EXPECT_EQ(packet.info.point_count, points.size());
    EXPECT_EQ(points[0].range_mm, 10'030U);
    // 90 degrees clockwise from forward is 270 to the left.
    EXPECT_EQ(points[0].azimuth_ticks, 27'000 - 521);
    EXPECT_EQ(points[6 * lasers - 1].range_mm, 0xFFFFU * 4);
    EXPECT_EQ(points[6 * lasers - 1].layer, lasers - 1);
    EXPECT_EQ(points[6 * lasers - 1].azimuth_ticks, 54'000 - 36'000 - 5 * 20);
  }
}

TEST(Hesai, SweepsClockwiseSoItsSectorEndsWhereItBegan) {
  const Decoded packet(Sent{.first_azimuth = 35'960}.bytes(), false);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  EXPECT_EQ(packet.info.sector.width_ticks, 6 * 20 + HesaiPacket::kSeamTicks);
  EXPECT_EQ(packet.info.sector.first_ticks, 36'000 - 80 - HesaiPacket::kSeamTicks);
}

// Pandar64 User Manual: block 6 fires 42.58 us before the stamp, the lasers of a block 3.62
// to 54.67 us before it, a block 55.56 us before the next. PandarXT User Manual: block 8
// fires 5.632 us after the stamp, laser n 0.368 + 1.512 (n - 1) us later, a block 50 us before the
// next.
TEST(Hesai, ItsTimesAreThoseOfTheManuals) {
  constexpr std::uint64_t kStampUs = 1'709'251'199'500'000U;  // 2024-02-29 23:59:59.5 UTC
  struct Row {
    bool is_xt32;
    bool is_dual;
    double first_us;
    double last_us;
  };
  for (const Row& row : {Row{false, false, -42.58 - 5 * 55.56 - 54.67, -42.58 - 3.62},
                         Row{false, true, -42.58 - 2 * 55.56 - 54.67, -42.58 - 3.62},
                         Row{true, false, 5.632 - 7 * 50 + 0.368, 5.632 + 0.368 + 31 * 1.512},
                         Row{true, true, 5.632 - 3 * 50 + 0.368, 5.632 + 0.368 + 31 * 1.512}}) {
    Sent sent{.is_xt32 = row.is_xt32, .mode = row.is_dual ? 0x39 : 0x37, .is_dual = row.is_dual};
    for (const int year : {24, 124}) {
      sent.utc[0] = year;
      const Decoded packet(sent.bytes(), row.is_xt32);
      ASSERT_EQ(packet.status, DecodeStatus::kOk);
      const Sweep sweep = packet.info.sweep;
      const auto since = [](std::uint64_t us) {
        return static_cast<double>(static_cast<std::int64_t>(us - kStampUs));
      };
      EXPECT_NEAR(since(sweep.begin_us), row.first_us, 0.51);
      EXPECT_NEAR(since(sweep.end_us), row.last_us, 0.51);
      EXPECT_TRUE(sweep.turns_right);
    }
  }
}

// Days by a calendar that is not the code's own.
TEST(Hesai, DatesAreThoseOfTheCalendar) {
  struct Row {
    std::array<int, 6> utc;
    std::uint64_t unix_s;
  };
  for (const auto& [utc, unix_s] : std::vector<Row>{{{100, 3, 1, 0, 0, 0}, 951'868'800},
                                                    {{69, 12, 31, 0, 0, 0}, 3'155'673'600},
                                                    {{70, 1, 1, 0, 0, 0}, 0},
                                                    {{120, 6, 25, 12, 2, 9}, 1'593'086'529},
                                                    {{0, 0, 1, 2, 3, 4}, 0x01020304}}) {
    // The last laser of an XT-32 fires 52.872 us after the stamp.
    const Decoded packet(Sent{.is_xt32 = true, .utc = utc, .time_us = 0}.bytes(), true);
    ASSERT_EQ(packet.status, DecodeStatus::kOk);
    EXPECT_EQ(packet.info.sweep.end_us, unix_s * 1'000'000 + 53);
  }
}

// A real Pandar64 sends the farther return first, a real XT-32 the nearer.
TEST(Hesai, OfARealPairTheNearerIsTheFirstEcho) {
  const Decoded packet(tests::real_pandar64(), false);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  const auto& points = packet.points;
  ASSERT_EQ(points.size(), 384U);
  EXPECT_EQ(points[0].range_mm, 552U);  // 2228 and 552 on the wire
  EXPECT_EQ(points[64].range_mm, 2228U);
  EXPECT_EQ(points[0].azimuth_ticks, 36'000 - 251);
  EXPECT_EQ(points[64].azimuth_ticks, 36'000 - 251);
  EXPECT_EQ(points[5].range_mm, 1452U);  // twice the same
  EXPECT_EQ(points[64 + 5].range_mm, 0U);
  EXPECT_EQ(points[2 * 64 + 14].range_mm, 2136U);  // and nothing
  EXPECT_EQ(points[3 * 64 + 14].range_mm, 0U);
  EXPECT_EQ(points[64 + 5].echo, 1);
  EXPECT_EQ(packet.info.sector.width_ticks, 3 * 20 + HesaiPacket::kSeamTicks);
  // 2020-06-25 12:02:09 UTC and 977,841 us.
  EXPECT_EQ(packet.info.sweep.end_us, 1'593'086'529'977'841U - 46);
}

TEST(Hesai, ARealXt32IsUnderstood) {
  const Decoded packet(tests::real_xt32(), true);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  const auto& points = packet.points;
  ASSERT_EQ(points.size(), 256U);
  EXPECT_EQ(points[0].range_mm, 752U);
  EXPECT_EQ(points[32].range_mm, 2292U);
  EXPECT_EQ(points[20].range_mm, 492U);
  EXPECT_EQ(points[31].range_mm, 204U);
  EXPECT_EQ(points[255].azimuth_ticks, 36'000 - 378);
  // 2019-07-25 03:19:29 UTC and 619,765 us.
  EXPECT_EQ(packet.info.sweep.end_us, 1'564'024'769'619'765U + 53);
}

TEST(Hesai, RefusesWhatIsNotItsUnit) {
  for (const bool is_xt32 : {false, true}) {
    const auto good = Sent{.is_xt32 = is_xt32}.bytes();
    const std::size_t unit_at = is_xt32 ? 9 : 5;
    const std::size_t counts_at = is_xt32 ? 6 : 2;
    const std::size_t mode_at = is_xt32 ? 1062 : 1186;
    const std::size_t maker_at = is_xt32 ? 1075 : 1187;
    for (const std::size_t at : {std::size_t{0}, std::size_t{1}, std::size_t{2}, unit_at, counts_at,
                                 counts_at + 1, mode_at, maker_at}) {
      auto bytes = good;
      bytes[at] ^= std::byte{0x40};
      EXPECT_EQ(decode(bytes, is_xt32), DecodeStatus::kWrongType) << at;
    }
    EXPECT_EQ(decode(Sent{.is_xt32 = is_xt32, .step = 301}.bytes(), is_xt32),
              DecodeStatus::kWrongAngle);
    EXPECT_EQ(decode(Sent{.is_xt32 = is_xt32, .mode = 0x39}.bytes(), is_xt32),
              DecodeStatus::kWrongAngle)
        << "no pairs";
  }
}

}  // namespace
}  // namespace iog::lidar
