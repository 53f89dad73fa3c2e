// The points of a sampling are those of its layers in every so manyth firing, as for_each_point()
// has them, and its ranges are theirs.
#include "lidar/sampling.hpp"

#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/hesai_packet.hpp"
#include "fakes/ouster_packet.hpp"
#include "fakes/random.hpp"
#include "fakes/velodyne_packet.hpp"
#include "lidar/formats.hpp"
#include "lidar/unit.hpp"

namespace iog::lidar {
namespace {

using tests::Random;

std::vector<std::size_t> firings_of(int log2_firings, std::size_t firings) {
  std::vector<std::size_t> numbers;
  Sampling{.log2_firings = log2_firings}.for_each_firing(
      firings, [&](std::size_t firing) { numbers.push_back(firing); });
  return numbers;
}

TEST(Sampling, SpreadsFiringsEvenly) {
  EXPECT_EQ(firings_of(1, 6), (std::vector<std::size_t>{1, 4}));
  EXPECT_EQ(firings_of(2, 12), (std::vector<std::size_t>{1, 4, 7, 10}));
  EXPECT_EQ(firings_of(3, 24), (std::vector<std::size_t>{1, 4, 7, 10, 13, 16, 19, 22}));
  EXPECT_EQ(firings_of(2, 6), (std::vector<std::size_t>{0, 2, 3, 5}));
  EXPECT_EQ(firings_of(1, 3), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(firings_of(3, 4), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_TRUE(firings_of(3, 0).empty());
}

bool is_same(const ScanPoint& a, const ScanPoint& b) {
  return a.range_mm == b.range_mm && a.azimuth_ticks == b.azimuth_ticks && a.layer == b.layer &&
         a.echo == b.echo;
}

// On the wire a firing has one first echo of each layer, in the layers' order. Which range of a
// pair stands first there is up to the unit.
template <typename Decoder>
void expect_samples(const Decoder& packet, std::size_t layers, std::uint32_t range_unit_mm) {
  std::array<std::vector<ScanPoint>, 2> echoes;
  packet.for_each_point([&](const ScanPoint& point) { echoes.at(point.echo).push_back(point); });
  const std::vector<ScanPoint>& first_echoes = echoes[0];
  const std::vector<ScanPoint>& last_echoes = echoes[1].empty() ? echoes[0] : echoes[1];
  ASSERT_EQ(first_echoes.size() % layers, 0U);
  ASSERT_EQ(first_echoes.size(), last_echoes.size());
  const std::array<std::uint8_t, 4> some{static_cast<std::uint8_t>(layers - 1), 0, 3,
                                         static_cast<std::uint8_t>(layers / 2)};
  for (int log2_firings = 0; log2_firings <= 4; ++log2_firings) {
    std::vector<ScanPoint> expected;
    std::vector<std::uint32_t> last_ranges;
    for (const std::size_t firing : firings_of(log2_firings, first_echoes.size() / layers)) {
      for (const std::uint8_t layer : some) {
        expected.push_back(first_echoes[firing * layers + layer]);
        last_ranges.push_back(last_echoes[firing * layers + layer].range_mm);
        ASSERT_EQ(expected.back().layer, layer);
      }
    }
    const Sampling sampling{.layers = some, .log2_firings = log2_firings};
    std::size_t points = 0;
    packet.for_each_sample(sampling, [&](const ScanPoint& point) {
      ASSERT_LT(points, expected.size());
      EXPECT_TRUE(is_same(point, expected[points]));
      ++points;
    });
    EXPECT_EQ(points, expected.size());
    std::size_t ranges = 0;
    static_cast<void>(packet.for_each_range(sampling, [&](std::uint32_t range) {
      ASSERT_LT(ranges, expected.size());
      const std::uint32_t range_mm = range * range_unit_mm;
      EXPECT_TRUE(range_mm == expected[ranges].range_mm || range_mm == last_ranges[ranges]);
      ++ranges;
    }));
    EXPECT_EQ(ranges, expected.size());
  }
}

template <typename Decoder, typename Packet>
void expect_samples_of_random(Packet& packet, Random& random, std::uint32_t unit_mm) {
  for (auto& block : packet.ranges) {
    for (int& range : block) {
      range = random.between(0, 60'000);
    }
  }
  const std::vector<std::byte> bytes = packet.bytes();
  Decoder decoder;
  ASSERT_EQ(decoder.decode(bytes), DecodeStatus::kOk);
  expect_samples(decoder, Decoder::kLayers, unit_mm);
}

template <typename Decoder>
void expect_samples_of_velodyne(int product, int banks = 1) {
  Random random(1);
  for (const bool is_dual : {false, true}) {
    tests::VelodynePacket packet;
    packet.first_azimuth = 35'900;
    packet.product = product;
    if (is_dual && banks == 4) {
      return;  // a mode that is not taken
    }
    packet.banks = banks;
    packet.mode = is_dual && banks == 1 ? 0x39 : 0x37;
    packet.blocks_of_azimuth = banks * (is_dual ? 2 : 1);
    expect_samples_of_random<Decoder>(packet, random, Decoder::unit().range_unit_mm);
  }
}

TEST(Sampling, OfVelodynes) {
  expect_samples_of_velodyne<VelodyneVlp16>(0x22);
  expect_samples_of_velodyne<VelodyneHdl32e>(0x21);
  expect_samples_of_velodyne<VelodynePuckHires>(0x24);
  expect_samples_of_velodyne<VelodyneVlp32c>(0x28);
  expect_samples_of_velodyne<VelodyneHdl64eS2>(0, 2);
  expect_samples_of_velodyne<VelodyneHdl64eS3>(0, 2);
  expect_samples_of_velodyne<VelodyneVls128>(0xA1, 4);
}

template <typename Decoder>
void expect_samples_of_hesai() {
  Random random(2);
  for (const bool is_dual : {false, true}) {
    tests::HesaiPacket packet{
        .format = kFormat<Decoder>, .mode = is_dual ? 0x39 : 0x37, .is_dual = is_dual};
    expect_samples_of_random<Decoder>(packet, random, Decoder::unit().distance_unit_mm);
  }
}

TEST(Sampling, OfHesais) {
  expect_samples_of_hesai<HesaiPandar40p>();
  expect_samples_of_hesai<HesaiPandar64>();
  expect_samples_of_hesai<HesaiQt64>();
  expect_samples_of_hesai<HesaiQt128>();
  expect_samples_of_hesai<HesaiXt16>();
  expect_samples_of_hesai<HesaiXt32>();
  expect_samples_of_hesai<HesaiXt32m>();
}

TEST(Sampling, OfOusters) {
  Random random(3);
  for (const std::size_t rows : {16U, 64U, 128U}) {
    tests::OusterPacket packet;
    packet.rows = static_cast<int>(rows);
    packet.first_measured = 3;
    for (auto& column : packet.ranges) {
      for (std::uint32_t& range : column) {
        range = static_cast<std::uint32_t>(random.between(0, 200'000));
      }
    }
    const std::vector<LaserCorrection> corrections(rows);
    const std::vector<std::byte> bytes = packet.bytes();
    OusterLegacy decoder;
    ASSERT_EQ(
        decoder.decode(bytes,
                       {.corrections = corrections, .columns_per_turn = 1024, .column_ns = 97'656}),
        DecodeStatus::kOk);
    expect_samples(decoder, rows, 1);
  }
}

}  // namespace
}  // namespace iog::lidar
