#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/hesai_packet.hpp"
#include "fakes/real_hesai_packets.hpp"
#include "fakes/real_packets.hpp"
#include "fakes/real_qt128_packet.hpp"
#include "lidar/decoded.hpp"

namespace iog::lidar {
namespace {

using Sent = tests::HesaiPacket;
using tests::kHesaiFormats;

constexpr Format kPandar40p = kFormat<HesaiPandar40p>;
constexpr Format kPandar64 = kFormat<HesaiPandar64>;
constexpr Format kQt64 = kFormat<HesaiQt64>;
constexpr Format kQt128 = kFormat<HesaiQt128>;
constexpr Format kXt16 = kFormat<HesaiXt16>;
constexpr Format kXt32 = kFormat<HesaiXt32>;
constexpr Format kXt32m = kFormat<HesaiXt32m>;

DecodeStatus decode(const std::vector<std::byte>& bytes, Format format) {
  return Decoded(bytes, format).status;
}

// User manuals: of a Pandar40P 1262 bytes, 1266 with a sequence number; of a Pandar64 1194, 1198;
// of a PandarQT-64 1068, 1072; of a QT128 1095, 1127 with a signature; of a PandarXT-16 568, of a
// PandarXT-32 1080, of a PandarXT-32M 820.
TEST(Hesai, PacketsAreAsLongAsTheManualsSay) {
  struct Row {
    Format format;
    std::size_t bytes;
    std::size_t bytes_without_sequence;
  };
  for (const Row& row : {Row{kPandar40p, 1266, 1262}, Row{kPandar64, 1198, 1194},
                         Row{kQt64, 1072, 1068}, Row{kQt128, 1127, 1095}, Row{kXt16, 568, 568},
                         Row{kXt32, 1080, 1080}, Row{kXt32m, 820, 820}}) {
    auto bytes = Sent{.format = row.format}.bytes();
    EXPECT_EQ(bytes.size(), row.bytes);
    EXPECT_EQ(decode(bytes, row.format), DecodeStatus::kOk);
    for (const Format other : kHesaiFormats) {
      EXPECT_EQ(decode(bytes, other) == DecodeStatus::kOk, other == row.format);
    }
    bytes.pop_back();
    EXPECT_EQ(decode(bytes, row.format), DecodeStatus::kWrongLength);
    EXPECT_EQ(decode({}, row.format), DecodeStatus::kWrongLength);
    const auto shorter = Sent{.format = row.format, .has_sequence = false}.bytes();
    EXPECT_EQ(shorter.size(), row.bytes_without_sequence);
    EXPECT_EQ(decode(shorter, row.format), DecodeStatus::kOk);
  }
}

TEST(Hesai, TurnsUnitsIntoPoints) {
  for (const Format format : kHesaiFormats) {
    Sent sent{.format = format, .first_azimuth = 9000};
    const auto lasers = static_cast<std::size_t>(sent.layout().lasers);
    const auto blocks = static_cast<std::size_t>(sent.layout().blocks);
    sent.ranges[0][0] = 2500;
    sent.ranges[blocks - 1][lasers - 1] = 0xFFFF;
    std::array<LaserCorrection, 128> lasers_of_unit{};
    lasers_of_unit[0] = {.azimuth_ticks = -521, .range_mm = 30};
    lasers_of_unit[lasers - 1] = {.azimuth_ticks = 27'000, .range_mm = 0};
    const Decoded packet(sent.bytes(), format,
                         {.corrections = std::span(lasers_of_unit).first(lasers)});
    ASSERT_EQ(packet.status, DecodeStatus::kOk);
    const auto& points = packet.points;
    ASSERT_EQ(points.size(), blocks * lasers);
    EXPECT_EQ(packet.info.point_count, points.size());
    const std::uint32_t unit_mm = format == kXt32m ? 5 : 4;
    EXPECT_EQ(points[0].range_mm, 2500 * unit_mm + 30);
    // 90 degrees clockwise from forward is 270 to the left.
    EXPECT_EQ(points[0].azimuth_ticks, 27'000 - 521);
    EXPECT_EQ(points.back().range_mm, 0xFFFFU * unit_mm);
    EXPECT_EQ(points.back().layer, lasers - 1);
    EXPECT_EQ(points.back().azimuth_ticks, 54'000 - 36'000 - static_cast<int>(blocks - 1) * 20);
  }
}

TEST(Hesai, SweepsClockwiseSoItsSectorEndsWhereItBegan) {
  const Decoded packet(Sent{.first_azimuth = 35'960}.bytes(), kPandar64);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  EXPECT_EQ(packet.info.sector.width_ticks, 6 * 20 + HesaiPacket::kSeamTicks);
  EXPECT_EQ(packet.info.sector.first_ticks, 36'000 - 80 - HesaiPacket::kSeamTicks);
}

// A QT128 with two returns sends each firing on its own: its speed says how far it turns meanwhile,
// by which its packets leave no azimuth out.
TEST(Hesai, AFiringThatIsAloneSweepsAsFarAsTheHeadTurns) {
  struct Row {
    int rpm;
    std::uint16_t ticks;
  };
  for (const Row& row : {Row{300, 20}, Row{599, 40}, Row{1200, 80}, Row{0, 0}}) {
    Sent sent{.format = kQt128, .first_azimuth = 35'980, .mode = 0x39, .is_dual = true};
    sent.rpm = row.rpm;
    const Decoded packet(sent.bytes(), kQt128);
    ASSERT_EQ(packet.status, DecodeStatus::kOk);
    EXPECT_EQ(packet.info.sector.width_ticks, row.ticks + HesaiPacket::kSeamTicks);
    EXPECT_EQ((packet.info.sector.first_ticks + packet.info.sector.width_ticks) % 36'000, 20);
    sent.rpm = 0xFFFF;
    EXPECT_EQ(decode(sent.bytes(), kQt128), DecodeStatus::kWrongAngle);
  }
}

// Pandar64 User Manual: block 6 fires 42.58 us before the stamp, the lasers of a block 3.62
// to 54.67 us before it, a block 55.56 us before the next. Pandar40P User Manual: the same, but
// block 10 28.58 us before the stamp. PandarXT User Manual: block 8 fires 5.632 us after the stamp,
// laser n of 32 0.368 + 1.512 (n - 1) us later, of 16 0.368 + 3.024 (n - 1), a block 50 us before
// the next. PandarXT-32M User Manual: the same of block 6, and lasers n and n + 16 0.368 + 2.888
// (n - 1) us later. PandarQT User Manual: block 1 25.71 us after the stamp, a block 166.67 us after
// the one before, the lasers 12.31 to 146.45 us later. HesaiLidar_SDK_2.0, QT128C2X: block 1 9 us
// after the stamp, a block 111.11 us after the one before, the lasers 0.6 to 100.52 us later.
TEST(Hesai, ItsTimesAreThoseOfTheManuals) {
  constexpr std::uint64_t kStampUs = 1'709'251'199'500'000U;  // 2024-02-29 23:59:59.5 UTC
  struct Row {
    Format format;
    bool is_dual;
    double first_us;
    double last_us;
  };
  for (const Row& row :
       {Row{kPandar64, false, -42.58 - 5 * 55.56 - 54.67, -42.58 - 3.62},
        Row{kPandar64, true, -42.58 - 2 * 55.56 - 54.67, -42.58 - 3.62},
        Row{kPandar40p, false, -28.58 - 9 * 55.56 - 54.67, -28.58 - 3.62},
        Row{kPandar40p, true, -28.58 - 4 * 55.56 - 54.67, -28.58 - 3.62},
        Row{kXt16, false, 5.632 - 7 * 50 + 0.368, 5.632 + 0.368 + 15 * 3.024},
        Row{kXt16, true, 5.632 - 3 * 50 + 0.368, 5.632 + 0.368 + 15 * 3.024},
        Row{kXt32, false, 5.632 - 7 * 50 + 0.368, 5.632 + 0.368 + 31 * 1.512},
        Row{kXt32, true, 5.632 - 3 * 50 + 0.368, 5.632 + 0.368 + 31 * 1.512},
        Row{kXt32m, false, 5.632 - 5 * 50 + 0.368, 5.632 + 0.368 + 15 * 2.888},
        Row{kXt32m, true, 5.632 - 2 * 50 + 0.368, 5.632 + 0.368 + 15 * 2.888},
        Row{kQt64, false, 25.71 + 12.31, 25.71 + 500 + 146.45},
        Row{kQt64, true, 25.71 + 12.31, 25.71 + 166.67 + 146.45},
        Row{kQt128, false, 9 + 0.6, 9 + 111.11 + 100.52}, Row{kQt128, true, 9 + 0.6, 9 + 100.52}}) {
    Sent sent{.format = row.format, .mode = row.is_dual ? 0x39 : 0x37, .is_dual = row.is_dual};
    for (const int year : {24, 124}) {
      sent.utc[0] = year;
      const Decoded packet(sent.bytes(), row.format);
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
    const Decoded packet(Sent{.format = kXt32, .utc = utc, .time_us = 0}.bytes(), kXt32);
    ASSERT_EQ(packet.status, DecodeStatus::kOk);
    EXPECT_EQ(packet.info.sweep.end_us, unix_s * 1'000'000 + 53);
  }
}

// A real Pandar64 sends the farther return first, a real XT-32 the nearer.
TEST(Hesai, OfARealPairTheNearerIsTheFirstEcho) {
  const Decoded packet(tests::real_pandar64(), kPandar64);
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
  const Decoded packet(tests::real_xt32(), kXt32);
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

// Where a point lies: forward, left and up, in mm. The azimuth has the laser's own offset already.
struct Place {
  double x;
  double y;
  double z;
};
Place place_of(const ScanPoint& point, double elevation_deg) {
  constexpr double kDegree = 3.14159265358979 / 180;
  const double elevation = elevation_deg * kDegree;
  const double azimuth = point.azimuth_ticks / 100.0 * kDegree;
  const double flat = point.range_mm * std::cos(elevation);
  return {flat * std::cos(azimuth), flat * std::sin(azimuth), point.range_mm * std::sin(elevation)};
}

// Nebula lists the returns of a firing by channels, in the order of the blocks. It knows azimuths
// to a thousandth of a degree, and here they are rounded to 0.01.
struct Nebula {
  std::array<std::size_t, 2> echoes{1, 0};  // the farther before the nearer, or the other way
  std::uint32_t range_min_mm = 1;           // it leaves out what is nearer
};
void expect_nebulas(const std::vector<ScanPoint>& points, std::span<const double> elevations_deg,
                    std::span<const tests::NebulaPoint> cloud, const Nebula& nebula = {}) {
  std::size_t next = 0;
  const std::size_t lasers = elevations_deg.size();
  for (std::size_t channel = 0; channel < lasers; ++channel) {
    for (const std::size_t echo : nebula.echoes) {
      const ScanPoint& point = points.at(echo * lasers + channel);
      EXPECT_EQ(point.echo, echo);
      if (point.range_mm < nebula.range_min_mm) {
        continue;
      }
      ASSERT_LT(next, cloud.size());
      const auto& its = cloud[next++];
      const Place place = place_of(point, elevations_deg[channel]);
      const double tolerance_mm = 1 + 1e-4 * point.range_mm;
      EXPECT_NEAR(place.x, its.y_mm, tolerance_mm) << channel;
      EXPECT_NEAR(-place.y, its.x_mm, tolerance_mm) << channel;
      EXPECT_NEAR(place.z, its.z_mm, tolerance_mm) << channel;
    }
  }
  EXPECT_EQ(next, cloud.size());
}

// Nebula's calibration/Pandar40P.csv: lasers 7 to 30 look 3.125 degrees to the right, 5.208 and
// 1.042 to the left, by turns from the seventh on; all others 1.042 to the left.
TEST(Hesai, ARealPandar40pIsWhereAnotherDecoderPutsIt) {
  constexpr std::array<double, 40> kElevationsDeg{
      14.794, 10.944, 7.971,  4.969,   2.952,  1.94,    1.6,     1.263,   0.925,   0.587,
      0.249,  -0.088, -0.425, -0.763,  -1.101, -1.439,  -1.776,  -2.116,  -2.453,  -2.788,
      -3.128, -3.463, -3.8,   -4.138,  -4.473, -4.808,  -5.145,  -5.479,  -5.814,  -6.149,
      -7.151, -8.147, -9.148, -10.133, -11.12, -12.094, -13.062, -14.018, -18.977, -24.985};
  std::vector<LaserCorrection> lasers(40, LaserCorrection{.azimuth_ticks = 104});
  for (std::size_t i = 6; i < 30; i += 3) {
    lasers[i].azimuth_ticks = -313;
    lasers[i + 1].azimuth_ticks = 521;
  }
  const Decoded packet(tests::real_pandar40p(), kPandar40p, {.corrections = lasers});
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  expect_nebulas(packet.points, kElevationsDeg, tests::kNebulaOfPandar40p);
}

TEST(Hesai, ARealXt16IsWhereAnotherDecoderPutsIt) {
  const Decoded packet(tests::real_xt16(), kXt16);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  expect_nebulas(packet.points, HesaiXt16::kElevationsDeg, tests::kNebulaOfXt16);
}

// Nebula's calibration/PandarQT64.csv. Fifteen beams of the firing have two returns, the nearer in
// the first block; what is nearer than 0.1 m nebula leaves out.
TEST(Hesai, ARealQt64IsWhereAnotherDecoderPutsIt) {
  constexpr std::array<double, 64> kElevationsDeg{
      -52.121, -49.785, -47.577, -45.477, -43.465, -41.528, -39.653, -37.831, -36.055, -34.32,
      -32.619, -30.95,  -29.308, -27.69,  -26.094, -24.517, -22.964, -21.42,  -19.889, -18.372,
      -16.865, -15.368, -13.88,  -12.399, -10.925, -9.457,  -7.994,  -6.535,  -5.079,  -3.626,
      -2.175,  -0.725,  0.725,   2.175,   3.626,   5.079,   6.534,   7.993,   9.456,   10.923,
      12.397,  13.877,  15.365,  16.861,  18.368,  19.885,  21.415,  22.959,  24.524,  26.101,
      27.697,  29.315,  30.957,  32.627,  34.328,  36.064,  37.84,   39.662,  41.537,  43.475,
      45.487,  47.587,  49.795,  52.133};
  constexpr std::array<std::int16_t, 64> kAzimuths{
      -874, -831, -796, -767, -742, -720, -701, -684, -669, -655, -643, -633, -623,
      -614, -606, -599, 527,  522,  517,  512,  508,  505,  502,  499,  496,  494,
      492,  491,  490,  489,  488,  488,  -549, -550, -550, -551, -552, -554, -556,
      -558, -561, -564, -568, -572, -576, -581, -586, -592, 533,  540,  547,  555,
      564,  574,  585,  597,  611,  627,  645,  665,  689,  716,  749,  789};
  std::vector<LaserCorrection> lasers;
  for (const std::int16_t azimuth : kAzimuths) {
    lasers.push_back({.azimuth_ticks = azimuth});
  }
  const Decoded packet(tests::real_qt64(), kQt64, {.corrections = lasers});
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  expect_nebulas(packet.points, kElevationsDeg, tests::kNebulaOfQt64,
                 {.echoes = {0, 1}, .range_min_mm = 100});
}

// Lasers 1 to 32 did not fire then. What is nearer than 0.3 m nebula leaves out.
TEST(Hesai, ARealQt128IsWhereAnotherDecoderPutsIt) {
  std::vector<LaserCorrection> lasers;
  for (const std::int16_t azimuth : tests::kAzimuthsOfQt128) {
    lasers.push_back({.azimuth_ticks = azimuth});
  }
  const Decoded packet(tests::real_qt128(), kQt128, {.corrections = lasers});
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  expect_nebulas(packet.points, tests::kElevationsOfQt128Deg, tests::kNebulaOfQt128,
                 {.range_min_mm = 300});
  // By its own clock 2020-10-09 12:03:29 UTC and 518,451 us; 40 ticks by its 600 rpm.
  EXPECT_EQ(packet.info.sweep.end_us, 1'602'245'009'518'451U + 110);
  EXPECT_EQ(packet.info.sector.width_ticks, 40 + HesaiPacket::kSeamTicks);
}

// Nebula's calibration/PandarXT32M.csv: within 0.13 degrees those of the data sheet, and lasers
// look up to 0.17 degrees to the sides. The unit was set to the first and the strongest return.
TEST(Hesai, ARealXt32mIsWhereAnotherDecoderPutsIt) {
  constexpr std::array<double, 32> kElevationsDeg{
      19.407,  18.106,  16.801,  15.512,  14.214,  12.917,  11.661,  10.362,
      9.066,   7.769,   6.475,   5.181,   3.885,   2.595,   1.299,   -0.005,
      -1.31,   -2.605,  -3.905,  -5.204,  -6.496,  -7.792,  -9.087,  -10.386,
      -11.685, -12.955, -14.242, -15.537, -16.834, -18.129, -19.424, -20.72};
  constexpr std::array<std::int16_t, 32> kAzimuths{-9, -9, -8, -8, -7, -6, -6, -5, -3, -3, -2,
                                                   -1, 0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                                   10, 11, 12, 13, 12, 12, 13, 15, 16, 17};
  std::vector<LaserCorrection> lasers;
  for (std::size_t channel = 0; channel < kAzimuths.size(); ++channel) {
    lasers.push_back({.azimuth_ticks = kAzimuths[channel]});
    EXPECT_NEAR(HesaiXt32m::kElevationsDeg[channel], kElevationsDeg[channel], 0.13);
  }
  const Decoded packet(tests::real_xt32m(), kXt32m, {.corrections = lasers});
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  expect_nebulas(packet.points, kElevationsDeg, tests::kNebulaOfXt32m, {.echoes = {0, 1}});
}

// Three returns of a beam: no recording of that mode is known.
TEST(Hesai, ThreeReturnsAreNotTaken) {
  EXPECT_EQ(decode(Sent{.format = kXt32m, .mode = 0x3D}.bytes(), kXt32m), DecodeStatus::kWrongType);
}

TEST(Hesai, RefusesWhatIsNotItsUnit) {
  struct Row {
    Format format;
    std::vector<std::size_t> checked;  // header or flags, counts, unit of distance, mode, maker
  };
  for (const Row& row :
       {Row{kPandar40p, {0, 1, 124, 9 * 124 + 1, 1254, 1255}},
        Row{kPandar64, {0, 1, 2, 3, 5, 1186, 1187}}, Row{kXt16, {0, 1, 2, 3, 6, 7, 9, 550, 563}},
        Row{kXt32, {0, 1, 2, 3, 6, 7, 9, 1062, 1075}}, Row{kXt32m, {0, 1, 2, 3, 6, 7, 9, 802, 815}},
        Row{kQt64, {0, 1, 2, 3, 6, 7, 9, 1060, 1061}},
        Row{kQt128, {0, 1, 2, 3, 6, 7, 9, 1073, 1086}}}) {
    const auto good = Sent{.format = row.format}.bytes();
    for (const std::size_t at : row.checked) {
      auto bytes = good;
      bytes[at] ^= std::byte{0x40};
      EXPECT_EQ(decode(bytes, row.format), DecodeStatus::kWrongType) << at;
    }
    EXPECT_EQ(decode(Sent{.format = row.format, .step = 301}.bytes(), row.format),
              DecodeStatus::kWrongAngle);
    EXPECT_EQ(decode(Sent{.format = row.format, .mode = 0x39}.bytes(), row.format),
              DecodeStatus::kWrongAngle)
        << "no pairs";
  }
}

}  // namespace
}  // namespace iog::lidar
