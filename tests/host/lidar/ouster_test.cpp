#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <type_traits>
#include <vector>

#include "fakes/ouster_packet.hpp"
#include "fakes/real_ouster_pixels.hpp"
#include "fakes/real_packets.hpp"
#include "lidar/decoded.hpp"

namespace iog::lidar {
namespace {

using Sent = tests::OusterPacket;

constexpr Format kLegacy = kFormat<OusterLegacy>;
constexpr Format kRng15 = kFormat<OusterRng15>;
constexpr Format kRng19 = kFormat<OusterRng19>;
constexpr Format kDual = kFormat<OusterRng19Dual>;
constexpr Format kFormats[] = {kLegacy, kRng15, kRng19, kDual};

// A unit whose rows look to the left by as many ticks as their numbers, and by turns to the right.
class TestUnit {
 public:
  explicit TestUnit(const Sent& packet, int turns_per_second = 10)
      : format_(packet.format), corrections_(static_cast<std::size_t>(packet.rows)) {
    for (std::size_t row = 0; row < corrections_.size(); ++row) {
      const auto ticks = static_cast<std::int16_t>(3 * row);
      corrections_[row].azimuth_ticks = row % 2 == 0 ? ticks : static_cast<std::int16_t>(-ticks);
    }
    unit_ = {.corrections = corrections_,
             .columns_per_turn = static_cast<std::uint16_t>(packet.columns_per_turn),
             .column_ns = static_cast<std::uint32_t>(1'000'000'000 /
                                                     (packet.columns_per_turn * turns_per_second))};
  }
  TestUnit(const TestUnit&) = delete;
  TestUnit& operator=(const TestUnit&) = delete;

  [[nodiscard]] Format format() const { return format_; }
  [[nodiscard]] const Unit& unit() const { return unit_; }
  [[nodiscard]] int offset(std::size_t row) const { return corrections_[row].azimuth_ticks; }
  void correct_range(std::size_t row, std::int16_t range_mm) {
    corrections_[row].range_mm = range_mm;
  }

 private:
  Format format_;
  std::vector<LaserCorrection> corrections_;
  Unit unit_;
};

Decoded decoded(std::span<const std::byte> bytes, const TestUnit& unit) {
  return {bytes, unit.format(), unit.unit()};
}

std::size_t packet_bytes(Format format, int rows) {
  std::size_t bytes = 0;
  with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    if constexpr (std::is_base_of_v<OusterPacket, Decoder>) {
      bytes = Decoder::packet_bytes(static_cast<std::size_t>(rows));
    }
  });
  return bytes;
}

// Firmware User Manual, "Lidar Data Packet Format": bytes of a packet of 16, 32, 64 and 128 rows.
TEST(Ouster, PacketsAreAsLongAsTheManualSays) {
  struct Row {
    Format format;
    std::array<std::size_t, 4> bytes;
  };
  for (const Row& row :
       {Row{kLegacy, {3392, 6464, 12608, 24896}}, Row{kRng15, {1280, 2304, 4352, 8448}},
        Row{kRng19, {3328, 6400, 12544, 24832}}, Row{kDual, {4352, 8448, 16640, 33024}}}) {
    for (std::size_t i = 0; i < row.bytes.size(); ++i) {
      const Sent packet{.format = row.format, .rows = 16 << i};
      const TestUnit unit(packet);
      EXPECT_EQ(packet_bytes(row.format, packet.rows), row.bytes[i]);
      auto datagram = packet.bytes();
      ASSERT_EQ(datagram.size(), row.bytes[i]);
      EXPECT_EQ(decoded(datagram, unit).status, DecodeStatus::kOk);
      datagram.pop_back();
      EXPECT_EQ(decoded(datagram, unit).status, DecodeStatus::kWrongLength);
      datagram.resize(row.bytes[i] + 1);
      EXPECT_EQ(decoded(datagram, unit).status, DecodeStatus::kWrongLength);
    }
  }
}

// Ranges: 20 bits of mm, of which old firmware fills the rest with other things; 15 bits of 8 mm;
// 19 bits of mm.
TEST(Ouster, RangesHaveTheBitsOfTheirProfile) {
  const std::uint32_t expected[] = {0xF'FFFF, 0x7FFF * 8, 0x7'FFFF};
  for (std::size_t i = 0; i < 3; ++i) {  // with two returns: below
    Sent sent{.format = kFormats[i], .rows = 32};
    sent.ranges[3][7] = 0xFFFF'FFFF;
    sent.ranges[15][31] = 1;
    const TestUnit unit(sent);
    const Decoded packet = decoded(sent.bytes(), unit);
    ASSERT_EQ(packet.status, DecodeStatus::kOk);
    const auto& points = packet.points;
    ASSERT_EQ(points.size(), 16U * 32);
    EXPECT_EQ(packet.info.point_count, points.size());
    EXPECT_EQ(points[3 * 32 + 7].range_mm, expected[i]);
    EXPECT_EQ(points[3 * 32 + 7].layer, 7);
    EXPECT_EQ(points[15 * 32 + 31].range_mm, i == 1 ? 8U : 1U);
    EXPECT_EQ(points[0].range_mm, 0U);
  }
}

// Ranges of 19 bits in the first two words; whichever of them is nearer is the first echo.
TEST(Ouster, OfTwoReturnsTheNearerIsTheFirstEcho) {
  Sent sent{.format = kDual, .rows = 32};
  sent.ranges[3][7] = 9'000;
  sent.second_ranges[3][7] = 4'000;
  sent.ranges[3][8] = 4'000;
  sent.second_ranges[3][8] = 0xF7'FFFF;  // five bits of flags above it
  sent.ranges[15][31] = 5'000;
  const TestUnit unit(sent);
  const Decoded packet = decoded(sent.bytes(), unit);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  ASSERT_EQ(packet.points.size(), 2U * 16 * 32);
  EXPECT_EQ(packet.info.point_count, packet.points.size());
  EXPECT_EQ(OusterRng19Dual::points_of_packet(32), packet.points.size());
  const auto expect = [&](std::size_t column, std::size_t row, unsigned nearer_mm,
                          unsigned farther_mm) {
    const ScanPoint* const pair = &packet.points.at(2 * (column * 32 + row));
    EXPECT_EQ(pair[0].range_mm, nearer_mm);
    EXPECT_EQ(pair[1].range_mm, farther_mm);
    for (const std::size_t echo : {0U, 1U}) {
      EXPECT_EQ(pair[echo].echo, echo);
      EXPECT_EQ(pair[echo].layer, row);
      EXPECT_EQ(pair[echo].azimuth_ticks,
                (46'080 / 2 - static_cast<int>(column) * 45 + unit.offset(row) + 46'080) % 46'080);
    }
  };
  expect(3, 7, 4'000, 9'000);
  expect(3, 8, 4'000, 0x7'FFFF);
  expect(15, 31, 5'000, 0);
}

// 8448 bytes are 128 rows in RNG15 and 32 with two returns, 4352 64 and 16. What no unit of the one
// profile sends tells them apart, as soon as something is seen.
TEST(Ouster, RowsAreNotTakenForReturns) {
  for (const int rows : {16, 32}) {
    Sent dual{.format = kDual, .rows = rows};
    Sent low_rate{.format = kRng15, .rows = 4 * rows};
    const TestUnit dual_unit(dual);
    const TestUnit low_rate_unit(low_rate);
    for (std::size_t column = 0; column < 16; ++column) {
      dual.ranges[column].assign(128, 12'345);
      low_rate.ranges[column].assign(128, 1'234);
    }
    EXPECT_EQ(decoded(dual.bytes(), dual_unit).status, DecodeStatus::kOk);
    EXPECT_EQ(decoded(dual.bytes(), low_rate_unit).status, DecodeStatus::kOtherUnit);
    EXPECT_EQ(decoded(low_rate.bytes(), low_rate_unit).status, DecodeStatus::kOk);
    EXPECT_EQ(decoded(low_rate.bytes(), dual_unit).status, DecodeStatus::kOtherUnit);
  }
}

// A row's range correction is added to what was measured, and to nothing else.
TEST(Ouster, RangesAreCorrectedByRow) {
  Sent sent{.rows = 16};
  sent.ranges[0][1] = 5'000;
  sent.ranges[0][2] = 5'000;
  TestUnit unit(sent);
  unit.correct_range(1, -40);
  unit.correct_range(3, 40);
  const Decoded packet = decoded(sent.bytes(), unit);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  EXPECT_EQ(packet.points[1].range_mm, 4'960U);
  EXPECT_EQ(packet.points[2].range_mm, 5'000U);
  EXPECT_EQ(packet.points[3].range_mm, 0U);
}

// 20 bits are the most that a range has; with its correction it would have 21.
TEST(Ouster, NoCorrectionTakesARangeBeyondTheFarthest) {
  Sent sent{.rows = 16};
  sent.ranges[0][1] = 0x0F'FFFF;
  TestUnit unit(sent);
  unit.correct_range(1, 10'000);
  const Decoded packet = decoded(sent.bytes(), unit);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  EXPECT_EQ(packet.points[1].range_mm, 0x0F'FFFFU);
}

Sent sent_in_turn(int columns, int first) {
  return {.rows = 16,
          .columns_per_turn = columns,
          .first_column = first,
          .column_ns = 100'000'000U / static_cast<unsigned>(columns)};
}

// Software Manual, "Lidar Range to XYZ": theta = 360 deg (1 - id / W), a beam at theta minus its
// own azimuth; the lidar's axes are the sensor's, turned by 180 deg. To the nearest tick; a tie, as
// of every second of 2048 columns, goes clockwise (docs/spec.md 1.2.1).
TEST(Ouster, AzimuthsAreThoseOfTheManual) {
  for (const int columns : {512, 1024, 2048}) {
    for (int first = 0; first < columns; first += 16) {
      const Sent sent = sent_in_turn(columns, first);
      const TestUnit unit(sent);
      const Decoded packet = decoded(sent.bytes(), unit);
      ASSERT_EQ(packet.status, DecodeStatus::kOk);
      const auto& points = packet.points;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double theta = 1.0 - (first + static_cast<double>(i / 16)) / columns;
        const double expected = (theta + 0.5) * 46'080 + unit.offset(i % 16);
        const double off = std::remainder(points[i].azimuth_ticks - expected, 46'080);
        ASSERT_TRUE(off >= -0.5 && off < 0.5) << columns << " " << first << " " << i;
        ASSERT_LT(points[i].azimuth_ticks, 46'080);
      }
    }
  }
}

// The sectors of a turn's packets follow one another: they meet, and together are a turn.
TEST(Ouster, SectorsOfATurnMeet) {
  for (const int columns : {512, 1024, 2048}) {
    int turned = 0;
    int seam = 46'080 / 2;
    for (int first = 0; first < columns; first += 16) {
      const Sent sent = sent_in_turn(columns, first);
      const TestUnit unit(sent);
      const Decoded packet = decoded(sent.bytes(), unit);
      ASSERT_EQ(packet.status, DecodeStatus::kOk);
      const Sector sector = packet.info.sector;
      turned += sector.width_ticks;
      EXPECT_EQ((sector.first_ticks + sector.width_ticks) % 46'080, seam);
      seam = sector.first_ticks;
    }
    EXPECT_EQ(turned, 46'080);
  }
}

// 1024 columns ten times a second are 97.656 us apart.
TEST(Ouster, ItsTimesAreThoseOfItsColumns) {
  const Sent sent{.format = kRng19, .frame = 0xFFFE};
  const TestUnit unit(sent);
  const Decoded packet = decoded(sent.bytes(), unit);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  EXPECT_EQ(packet.info.sweep.begin_us, 1'000'000'000U);
  EXPECT_EQ(packet.info.sweep.end_us, 1'000'000'000U + 1'562U);
  EXPECT_TRUE(packet.info.sweep.turns_right);
  EXPECT_EQ(packet.info.scan_number, 0xFFFEU);
}

// At the ends of its azimuth window a unit sends columns that it has not measured.
TEST(Ouster, ColumnsThatWereNotMeasuredAreNoPoints) {
  for (const Format format : kFormats) {
    Sent sent{.format = format, .first_column = 160, .first_measured = 5, .end_measured = 9};
    for (auto& column : sent.ranges) {
      column.assign(128, 1000);
    }
    const TestUnit unit(sent);
    const Decoded packet = decoded(sent.bytes(), unit);
    ASSERT_EQ(packet.status, DecodeStatus::kOk);
    EXPECT_EQ(packet.info.point_count, 4U * 64 * (format == kDual ? 2 : 1));
    EXPECT_EQ(packet.points.size(), packet.info.point_count);
    EXPECT_EQ(packet.info.sector.width_ticks, 4 * 45);
    EXPECT_EQ(packet.info.sector.first_ticks, 46'080 / 2 - 169 * 45);
  }
  const Sent nothing{.first_measured = 16};
  EXPECT_EQ(decoded(nothing.bytes(), TestUnit(nothing)).status, DecodeStatus::kWrongPoint);
}

// A unit in another mode has the same lengths. Its columns come at another rate, or its encoder is
// elsewhere.
TEST(Ouster, NoModeIsTakenForAnother) {
  struct Mode {
    int columns;
    int turns;
  };
  const std::vector<Mode> modes{{512, 10}, {1024, 10}, {2048, 10}, {512, 20}, {1024, 20}};
  for (const Format format : kFormats) {
    for (const Mode& is : modes) {
      Sent sent{.format = format, .columns_per_turn = is.columns, .first_column = 480};
      sent.column_ns = 1'000'000'000U / static_cast<unsigned>(is.columns * is.turns);
      const auto bytes = sent.bytes();
      for (const Mode& described : modes) {
        const Sent like{.format = format, .columns_per_turn = described.columns};
        const bool is_it = is.columns == described.columns && is.turns == described.turns;
        const bool looks_like_it = is.columns * is.turns == described.columns * described.turns &&
                                   format != kLegacy && described.columns > 495;
        EXPECT_EQ(decoded(bytes, TestUnit(like, described.turns)).status == DecodeStatus::kOk,
                  is_it || looks_like_it);
      }
    }
  }
}

// The heads of a real OS1-64's columns, and the pixels of its sixth column in each.
TEST(Ouster, ARealOs1IsUnderstood) {
  const auto heads = tests::real_os1_64_heads();
  const auto pixels = tests::real_os1_64_pixels();
  ASSERT_EQ(heads.size(), 16U * 16);
  ASSERT_EQ(pixels.size(), 64U * 12);
  std::vector<std::byte> bytes;
  for (std::ptrdiff_t column = 0; column < 16; ++column) {
    bytes.insert(bytes.end(), heads.begin() + 16 * column, heads.begin() + 16 * (column + 1));
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    bytes.insert(bytes.end(), 4, std::byte{0xFF});
  }
  const TestUnit unit(Sent{});
  const Decoded packet = decoded(bytes, unit);
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  EXPECT_EQ(packet.info.scan_number, 189U);
  EXPECT_EQ(packet.info.sweep.begin_us, 278'227'120U);
  EXPECT_EQ(packet.info.sector.width_ticks, 16 * 45);
  const auto& points = packet.points;
  ASSERT_EQ(points.size(), 1024U);
  EXPECT_EQ(points[0].range_mm, 1060U);
  EXPECT_EQ(points[1].range_mm, 1117U);
  EXPECT_EQ(points[20].range_mm, 0U);
  EXPECT_EQ(points[0].azimuth_ticks, 46'080 / 2 - 160 * 45);
}

// A packet of the profile whose columns all have these pixels.
std::vector<std::byte> packet_with(const Sent& like, const std::vector<std::byte>& pixels) {
  std::vector<std::byte> bytes = like.bytes();
  for (std::size_t column = 0; column < 16; ++column) {
    std::ranges::copy(pixels, bytes.begin() + static_cast<std::ptrdiff_t>(
                                                  32 + column * (12 + pixels.size()) + 12));
  }
  return bytes;
}

TEST(Ouster, OfARealOs0TwoReturnsAreThoseOfItsSdk) {
  const Sent like{.format = kDual, .rows = 32};
  const Decoded packet =
      decoded(packet_with(like, tests::real_os0_32_dual_pixels()), TestUnit(like));
  ASSERT_EQ(packet.status, DecodeStatus::kOk);
  for (std::size_t row = 0; row < 32; ++row) {
    const std::uint32_t first_mm = tests::kOs0DualFirst[row];
    const std::uint32_t second_mm = tests::kOs0DualSecond[row];
    const bool has_two = second_mm != 0;
    EXPECT_EQ(packet.points[2 * row].range_mm, has_two ? std::min(first_mm, second_mm) : first_mm);
    EXPECT_EQ(packet.points[2 * row + 1].range_mm, has_two ? std::max(first_mm, second_mm) : 0);
  }
  const Sent low_rate{.format = kRng15, .rows = 128};
  EXPECT_EQ(decoded(packet_with(like, tests::real_os0_32_dual_pixels()), TestUnit(low_rate)).status,
            DecodeStatus::kOtherUnit);
}

TEST(Ouster, RangesOfRealUnitsAreThoseOfTheSdk) {
  const auto expect = [](const Sent& like, const std::vector<std::byte>& pixels,
                         std::span<const std::uint32_t> ranges_mm) {
    const Decoded packet = decoded(packet_with(like, pixels), TestUnit(like));
    ASSERT_EQ(packet.status, DecodeStatus::kOk);
    for (std::size_t row = 0; row < ranges_mm.size(); ++row) {
      EXPECT_EQ(packet.points[row].range_mm, ranges_mm[row]) << row;
    }
  };
  expect({.format = kRng19, .rows = 32}, tests::real_os2_rng19_pixels(), tests::kOs2Rng19);
  expect({.format = kRng15, .rows = 128}, tests::real_os0_128_rng15_pixels(), tests::kOs0Rng15);
  const Sent dual{.format = kDual, .rows = 32};
  EXPECT_EQ(decoded(packet_with(dual, tests::real_os0_128_rng15_pixels()), TestUnit(dual)).status,
            DecodeStatus::kOtherUnit);
}

TEST(Ouster, RefusesWhatIsNotItsFormat) {
  Sent sent{.format = kRng19};
  const TestUnit unit(sent);
  const auto good = sent.bytes();
  auto bytes = good;
  bytes.at(0) = std::byte{2};
  EXPECT_EQ(decoded(bytes, unit).status, DecodeStatus::kWrongType);
  bytes = good;
  bytes[32 + 780 + 8] = std::byte{9};  // column 1 is called 9
  EXPECT_EQ(decoded(bytes, unit).status, DecodeStatus::kWrongAngle);
  bytes = good;
  bytes[32 + 7 * 780 + 10] = std::byte{0};  // a hole
  EXPECT_EQ(decoded(bytes, unit).status, DecodeStatus::kWrongAngle);
  sent.first_column = 1'020;  // up to 1035
  EXPECT_EQ(decoded(sent.bytes(), unit).status, DecodeStatus::kWrongAngle);
  EXPECT_EQ(decoded({}, unit).status, DecodeStatus::kWrongLength);
  Sent legacy{.frame = 1};
  const TestUnit legacy_unit(legacy);
  bytes = legacy.bytes();
  bytes[788 + 10] = std::byte{2};  // column 1 is of another turn
  EXPECT_EQ(decoded(bytes, legacy_unit).status, DecodeStatus::kWrongAngle);
}

}  // namespace
}  // namespace iog::lidar
