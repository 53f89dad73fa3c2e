#include "lidar/points.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>
#include <vector>

#include "fakes/points_packet.hpp"
#include "fakes/random.hpp"
#include "vehicle/azimuth_steps.hpp"

namespace iog::lidar {
namespace {

using Sent = tests::PointsPacket;

constexpr std::int32_t kDegree = 3'200;
constexpr std::int32_t kTurn = 360 * kDegree;
// Two degrees apart, but for the last.
constexpr std::array<std::int32_t, 4> kLayers{-2 * kDegree, 0, 2 * kDegree, 10 * kDegree};
constexpr Unit kUnit{.elevations = kLayers};

template <typename Decoder>
struct Decoded {
  explicit Decoded(const std::vector<std::byte>& bytes, const Unit& unit = kUnit) {
    Decoder decoder;
    status = decoder.decode(bytes, unit);
    info = decoder.info();
    if (status == DecodeStatus::kOk) {
      decoder.for_each_point([&](const ScanPoint& point) { points.push_back(point); });
    }
  }
  DecodeStatus status = DecodeStatus::kWrongType;
  PacketInfo info;
  std::vector<ScanPoint> points;
};

template <typename Decoder = Points>
DecodeStatus status_of(const Sent& sent) {
  return Decoded<Decoder>(sent.bytes()).status;
}

DecodeStatus status_with(auto&& change) {
  Sent sent{.points = {{.first = 10, .second = 20, .third = 30}}};
  change(sent);
  EXPECT_EQ(status_of<Points>(sent), status_of<PointsTurning>(sent));
  return status_of<Points>(sent);
}

ScanPoint point_of(const tests::SentPoint& sent, int flags = 0) {
  const Decoded<Points> its(Sent{.flags = flags, .points = {sent}}.bytes());
  EXPECT_EQ(its.status, DecodeStatus::kOk);
  return its.points.empty() ? ScanPoint{} : its.points[0];
}

TEST(Points, ADirectionIsThatOfTheWire) {
  const ScanPoint point = point_of({.first = 90 * kDegree, .second = 0, .third = 12'345});
  EXPECT_EQ(point.azimuth_ticks, 11'520 / 4);
  EXPECT_EQ(point.layer, 1);
  EXPECT_EQ(point.range_mm, 12'345U);
  EXPECT_EQ(point.echo, 0);
  EXPECT_FALSE(point.is_ground || point.is_dirt || point.is_rain);
  EXPECT_EQ(point_of({.first = 149}).azimuth_ticks, 1);
  EXPECT_EQ(point_of({.first = 150}).azimuth_ticks, 2);
  EXPECT_EQ(point_of({.first = kTurn - 51}).azimuth_ticks, 11'519);
  EXPECT_EQ(point_of({.first = kTurn - 1}).azimuth_ticks, 0);
}

TEST(Points, EveryFlagSaysOneThing) {
  EXPECT_EQ(point_of({.third = 9, .flags = 0x01}).echo, 1);
  EXPECT_EQ(point_of({.third = 9, .flags = 0x02}).echo, 2);
  EXPECT_EQ(point_of({.third = 9, .flags = 0x04}).range_mm, 0U);
  EXPECT_TRUE(point_of({.third = 9, .flags = 0x08}).is_ground);
  EXPECT_TRUE(point_of({.third = 9, .flags = 0x10}).is_dirt);
  EXPECT_TRUE(point_of({.third = 9, .flags = 0x20}).is_rain);
  const ScanPoint last = point_of({.third = 9, .flags = 0x40, .what = 200});
  EXPECT_EQ(last.range_mm, 9U);
  EXPECT_FALSE(last.is_ground || last.is_dirt || last.is_rain);
}

// What turns has two echoes.
TEST(Points, TheThirdEchoOfWhatTurnsIsALaterOne) {
  const Decoded<PointsTurning> its(Sent{.points = {{.third = 9, .flags = 2}}}.bytes());
  ASSERT_EQ(its.points.size(), 1U);
  EXPECT_EQ(its.points[0].echo, 1);
}

TEST(Points, HaveTheNearestLayerAndAreRainBeyondHalfOfOne) {
  const auto layer_at = [](double degrees) {
    const ScanPoint point = point_of({.second = std::lround(degrees * kDegree), .third = 9});
    return point.is_rain ? -1 : int{point.layer};
  };
  EXPECT_EQ(layer_at(-3.01), -1);
  EXPECT_EQ(layer_at(-3), 0);
  EXPECT_EQ(layer_at(-1.01), 0);
  EXPECT_EQ(layer_at(-1), 1);
  EXPECT_EQ(layer_at(0.99), 1);
  EXPECT_EQ(layer_at(5.99), 2);
  EXPECT_EQ(layer_at(6), 3);
  EXPECT_EQ(layer_at(14), 3);
  EXPECT_EQ(layer_at(14.01), -1);
}

// Whatever the layers are, by the least difference.
TEST(Points, FindTheirLayerAmongAny) {
  tests::Random random(1);
  for (int round = 0; round < 100; ++round) {
    std::set<std::int32_t> chosen;
    const std::size_t count = 1 + random.below(128);
    while (chosen.size() < count) {
      chosen.insert(random.between(-89 * kDegree, 89 * kDegree));
    }
    const std::vector<std::int32_t> layers(chosen.begin(), chosen.end());
    const LayerSearch search(layers);
    for (int i = 0; i < 1'000; ++i) {
      const std::int32_t at = random.between(-90 * kDegree, 90 * kDegree);
      const auto off = [&](std::int32_t layer) { return std::abs(layer - at); };
      ASSERT_EQ(off(layers[search.nearest(at)]), off(std::ranges::min(layers, {}, off)));
    }
  }
}

TEST(Points, OneLayerReachesHalfADegree) {
  constexpr std::array<std::int32_t, 1> kOne{0};
  const LayerSearch search(kOne);
  EXPECT_TRUE(search.sees(-1'600) && search.sees(1'600));
  EXPECT_FALSE(search.sees(-1'601) || search.sees(1'601));
  EXPECT_EQ(search.nearest(1'000), 0U);
}

// Millimetres and degrees by the C library.
TEST(Points, APlaceIsItsDirectionAndItsRange) {
  tests::Random random(2);
  std::vector<std::int32_t> layers;
  for (std::int32_t layer = -60; layer < 60; ++layer) {
    layers.push_back(layer * kDegree);
  }
  for (int i = 0; i < 20'000; ++i) {
    const int far = random.one_in(2) ? 1'000'000 : 30'000;
    const double x = random.between(-far, far);
    const double y = random.between(-far, far);
    const double z = random.between(-far / 2, far / 2);
    const tests::SentPoint sent{
        .first = std::lround(x), .second = std::lround(y), .third = std::lround(z)};
    const Decoded<Points> its(Sent{.flags = 1, .points = {sent}}.bytes(), {.elevations = layers});
    ASSERT_EQ(its.status, DecodeStatus::kOk);
    const ScanPoint& point = its.points[0];
    const double range = std::min(std::hypot(x, y, z), 1'048'575.0);
    EXPECT_NEAR(point.range_mm, range, 0.55);
    const double ticks = std::atan2(y, x) * 11'520 / (2 * std::numbers::pi);
    EXPECT_LE(std::abs(std::remainder(ticks - point.azimuth_ticks, 11'520)), 0.506);
    const double elevation = std::atan2(z, std::hypot(x, y)) * 180 / std::numbers::pi;
    if (std::abs(elevation) < 59) {
      EXPECT_LE(std::abs(elevation - (point.layer - 60)), 0.5005);
      EXPECT_FALSE(point.is_rain);
    }
  }
  EXPECT_EQ(point_of({}, 1).range_mm, 0U);
  EXPECT_EQ(point_of({.first = 1'000'000}, 1).range_mm, 1'000'000U);
  EXPECT_EQ(point_of({.first = 5'000, .second = -1}, 1).azimuth_ticks, 0);
}

// A place that says that nothing came back says its direction.
TEST(Points, NothingMayComeBackFromAPlace) {
  const ScanPoint point = point_of({.first = 0, .second = 2'000, .third = 0, .flags = 4}, 1);
  EXPECT_EQ(point.range_mm, 0U);
  EXPECT_EQ(point.azimuth_ticks, 11'520 / 4);
}

TEST(Points, TheHeadSaysScanSectorAndTimes) {
  const Sent sent{
      .scan_number = 0x1234'5678,
      .sector_begin = 350 * kDegree,
      .sector_width = 20 * kDegree,
      .points = {{.first = 350 * kDegree, .after = 3}, {.first = 10 * kDegree, .after = 2}}};
  const PacketInfo info = Decoded<Points>(sent.bytes()).info;
  EXPECT_EQ(info.scan_number, 0x1234'5678U);
  EXPECT_EQ(info.point_count, 2U);
  EXPECT_EQ(info.sector.first_ticks, 350 * 32);
  EXPECT_EQ(info.sector.width_ticks, 20 * 32);
  EXPECT_EQ(info.sweep.begin_us, 1'700'000'000'000'000U);
  EXPECT_EQ(info.sweep.end_us, 1'700'000'000'000'030U);
  EXPECT_TRUE(info.sweep.is_of_packet);
  EXPECT_FALSE(info.sweep.is_of_hour);
}

template <typename Decoder>
void expect_shares(std::uint32_t begin, std::uint32_t width, std::uint32_t scan_ticks) {
  std::uint32_t ticks = 0;
  std::uint32_t next = 0;
  for (int number = 0; number < 7; ++number) {
    const Sent sent{.flags = 2,
                    .number = number,
                    .datagrams = 7,
                    .sector_begin = begin,
                    .sector_width = width,
                    .points = {{.first = begin, .third = 7}}};
    const Decoded<Decoder> its(sent.bytes());
    ASSERT_EQ(its.status, DecodeStatus::kOk);
    EXPECT_TRUE(number == 0 || its.info.sector.first_ticks == next);
    const lidar::Sector& sector = its.info.sector;
    next = std::uint32_t{sector.first_ticks} + sector.width_ticks;
    next -= next < Decoder::kTicksPerTurn ? 0 : Decoder::kTicksPerTurn;
    ticks += sector.width_ticks;
  }
  EXPECT_EQ(ticks, scan_ticks);
}

// Whose datagrams have no sectors of their own: each stands for a share of it.
TEST(Points, SharesOfAScanAreAllOfIt) {
  expect_shares<Points>(0, kTurn, 11'520);
  expect_shares<Points>(325 * kDegree, 70 * kDegree, 70 * 32);
  expect_shares<PointsTurning>(0, kTurn, 32'768);
  expect_shares<PointsTurning>(77, kTurn, 32'768);
}

// An azimuth in hundredths of a degree, as Velodyne and Hesai send it, is of the step that it is of
// in their own ticks; and one of 1/128 degree, as of an Ouster.
TEST(Points, WhatTurnsHasTheStepsOfItsOwnTicks) {
  for (const std::int32_t own_turn : {36'000, 46'080}) {
    for (std::uint32_t steps = 256; steps <= 16'384; steps *= 2) {
      const vehicle::AzimuthSteps own(static_cast<std::uint32_t>(own_turn), steps);
      const vehicle::AzimuthSteps ours(PointsTurning::kTicksPerTurn, steps);
      ASSERT_TRUE(ours.is_valid());
      for (std::int32_t first = 0; first < own_turn; first += 80) {
        Sent sent;
        for (std::int32_t tick = first; tick < first + 80; ++tick) {
          sent.points.push_back({.first = std::int64_t{tick} * (kTurn / own_turn), .third = 1});
        }
        const Decoded<PointsTurning> its(sent.bytes());
        ASSERT_EQ(its.points.size(), 80U);
        for (std::uint32_t i = 0; i < 80; ++i) {
          ASSERT_EQ(ours.nearest(its.points[i].azimuth_ticks),
                    own.nearest(static_cast<std::uint32_t>(first) + i));
        }
      }
    }
  }
}

TEST(Points, EveryLengthButItsOwnIsRefused) {
  std::vector<std::byte> bytes = Sent{.points = std::vector<tests::SentPoint>(85)}.bytes();
  EXPECT_EQ(bytes.size(), 1'392U);
  EXPECT_EQ(Decoded<Points>(bytes).status, DecodeStatus::kOk);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<std::byte> shorter(bytes.begin(), bytes.begin() + static_cast<long>(size));
    EXPECT_EQ(Decoded<Points>(shorter).status, DecodeStatus::kWrongLength);
  }
  bytes.push_back({});
  EXPECT_EQ(Decoded<Points>(bytes).status, DecodeStatus::kWrongLength);
  const Sent long_one{.points = std::vector<tests::SentPoint>(86)};
  EXPECT_EQ(status_of(long_one), DecodeStatus::kWrongLength);
  EXPECT_EQ(status_of(Sent{}), DecodeStatus::kOk);
  EXPECT_EQ(Decoded<Points>(Sent{}.bytes(), Unit{}).status, DecodeStatus::kWrongLength);
}

TEST(Points, WhatIsNotOfTheFormatIsRefused) {
  EXPECT_EQ(status_with([](Sent& /*sent*/) {}), DecodeStatus::kOk);
  EXPECT_EQ(status_with([](Sent& sent) { ++sent.magic; }), DecodeStatus::kWrongType);
  EXPECT_EQ(status_with([](Sent& sent) { sent.version = 2; }), DecodeStatus::kWrongType);
  EXPECT_EQ(status_with([](Sent& sent) { sent.flags = 4; }), DecodeStatus::kWrongType);
  EXPECT_EQ(status_with([](Sent& sent) { sent.sector_begin = kTurn; }), DecodeStatus::kWrongAngle);
  EXPECT_EQ(status_with([](Sent& sent) { ++sent.sector_width; }), DecodeStatus::kWrongAngle);
  EXPECT_EQ(status_with([](Sent& sent) { sent.number = 1; }), DecodeStatus::kWrongAngle);
  EXPECT_EQ(status_with([](Sent& sent) { sent.datagrams = 0; }), DecodeStatus::kWrongAngle);
}

TEST(Points, APointThatCannotBeSpoilsItsDatagram) {
  const auto with = [](const tests::SentPoint& point, int flags = 0) {
    return status_with([&](Sent& sent) {
      sent.flags = flags;
      sent.points.push_back(point);
    });
  };
  EXPECT_EQ(with({.first = kTurn - 1, .second = 90 * kDegree, .third = 0xF'FFFF}),
            DecodeStatus::kOk);
  EXPECT_EQ(with({.second = -90 * kDegree}), DecodeStatus::kOk);
  EXPECT_EQ(with({.first = kTurn}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.first = -1}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.second = 90 * kDegree + 1}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.second = -90 * kDegree - 1}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.third = 0x10'0000}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.flags = 0x03}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.flags = 0x80}), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.first = 0xF'FFFF, .second = -0xF'FFFF, .third = 0xF'FFFF}, 1),
            DecodeStatus::kOk);
  EXPECT_EQ(with({.first = 0x10'0000}, 1), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.second = -0x10'0000}, 1), DecodeStatus::kWrongPoint);
  EXPECT_EQ(with({.third = 0x10'0000}, 1), DecodeStatus::kWrongPoint);
}

// A datagram of a sector of its own. One without a width says nothing of where its points are.
TEST(Points, ADirectionOutsideOfItsSectorIsRefused) {
  const auto at = [](std::int64_t azimuth, std::uint32_t width, int flags) {
    return status_with([&](Sent& sent) {
      sent.points = {{.first = azimuth, .second = 0, .third = 5}};
      sent.sector_begin = kTurn - 100;
      sent.sector_width = width;
      sent.flags = flags;
    });
  };
  EXPECT_EQ(at(kTurn - 100, 200, 0), DecodeStatus::kOk);
  EXPECT_EQ(at(100, 200, 0), DecodeStatus::kOk);
  EXPECT_EQ(at(101, 200, 0), DecodeStatus::kWrongPoint);
  EXPECT_EQ(at(kTurn - 101, 200, 0), DecodeStatus::kWrongPoint);
  EXPECT_EQ(at(101, 200, 2), DecodeStatus::kWrongPoint);
  EXPECT_EQ(at(101, 0, 0), DecodeStatus::kOk);
}

TEST(Points, TwoDatagramsHaveTwoNames) {
  const auto name_with = [](auto&& change) {
    Sent sent{.points = {{.third = 5}, {.third = 6}}};
    change(sent);
    return Decoded<Points>(sent.bytes()).info.fingerprint;
  };
  const std::set<std::uint64_t> names{name_with([](Sent& /*sent*/) {}),
                                      name_with([](Sent& sent) { ++sent.time_us; }),
                                      name_with([](Sent& sent) { ++sent.scan_number; }),
                                      name_with([](Sent& sent) { sent.datagrams = 2; }),
                                      name_with([](Sent& sent) { sent.points[0].third = 7; }),
                                      name_with([](Sent& sent) { sent.points[1].third = 7; })};
  EXPECT_EQ(names.size(), 6U);
}

TEST(Points, SamplesAreFirstEchoesOfTheirLayers) {
  Sent sent;
  for (int i = 0; i < 12; ++i) {
    sent.points.push_back({.second = kLayers[static_cast<std::size_t>(i % 4)],
                           .third = 100 + i,
                           .flags = i == 6 ? 1 : 0});
  }
  const std::vector<std::byte> bytes = sent.bytes();
  PointsTurning decoder;
  ASSERT_EQ(decoder.decode(bytes, kUnit), DecodeStatus::kOk);
  constexpr std::array<std::uint8_t, 2> kSome{1, 2};
  std::vector<std::uint32_t> ranges;
  decoder.for_each_sample({.layers = kSome, .log2_firings = 1},
                          [&](const ScanPoint& point) { ranges.push_back(point.range_mm); });
  EXPECT_EQ(ranges, (std::vector<std::uint32_t>{101, 102, 105, 109, 110}));
  std::uint32_t count = 0;
  static_cast<void>(
      decoder.for_each_range({}, [&](std::uint32_t range) { EXPECT_EQ(range, 100 + count++); }));
  EXPECT_EQ(count, 12U);
}

TEST(Points, OfPlacesEveryThirdIsASample) {
  const std::vector<std::byte> bytes =
      Sent{.flags = 1, .points = std::vector<tests::SentPoint>(10, {.first = 5'000})}.bytes();
  PointsTurning decoder;
  ASSERT_EQ(decoder.decode(bytes, kUnit), DecodeStatus::kOk);
  constexpr std::array<std::uint8_t, 1> kLevel{1};
  int count = 0;
  decoder.for_each_sample({.layers = kLevel}, [&](const ScanPoint& /*point*/) { ++count; });
  EXPECT_EQ(count, 4);
}

// Every place is a number of its own, but none from which nothing came back.
TEST(Points, RangesOfPlacesTellThemApart) {
  const auto range_of = [](const tests::SentPoint& point) {
    const std::vector<std::byte> bytes = Sent{.flags = 1, .points = {point}}.bytes();
    Points decoder;
    EXPECT_EQ(decoder.decode(bytes, kUnit), DecodeStatus::kOk);
    std::uint32_t range = 0;
    static_cast<void>(decoder.for_each_range({}, [&](std::uint32_t its) { range = its; }));
    return range;
  };
  const std::set<std::uint32_t> ranges{range_of({.first = 1}), range_of({.second = 1}),
                                       range_of({.third = 1}), range_of({.first = 1, .second = 1}),
                                       range_of({.first = 1, .flags = 4})};
  EXPECT_EQ(ranges.size(), 5U);
  EXPECT_EQ(range_of({.first = 1, .flags = 4}), 0U);
}

TEST(Points, AreReadFromTheCopyThatTheyWereMovedTo) {
  std::vector<std::byte> bytes = Sent{.points = {{.third = 5}}}.bytes();
  Points decoder;
  ASSERT_EQ(decoder.decode(bytes, kUnit), DecodeStatus::kOk);
  const std::vector<std::byte> copy = bytes;
  decoder.move_to(copy);
  std::ranges::fill(bytes, std::byte{0xFF});
  decoder.for_each_point([](const ScanPoint& point) { EXPECT_EQ(point.range_mm, 5U); });
}

}  // namespace
}  // namespace iog::lidar
