// What every decoder of the one list promises, whatever its format.
#include <gtest/gtest.h>
#include <set>
#include <string_view>
#include <type_traits>
#include <vector>

#include "fakes/ars548_list.hpp"
#include "fakes/effort.hpp"
#include "fakes/hesai_packet.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/mavlink_distance.hpp"
#include "fakes/ouster_packet.hpp"
#include "fakes/random.hpp"
#include "fakes/velodyne_packet.hpp"
#include "lidar/scanner_facts.hpp"

namespace iog::lidar {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t kOusterRows = 4;

// A sound packet of the format, one or two returns of each beam.
template <typename Decoder>
Bytes sound_packet(tests::Random& random) {
  bool is_dual = random.one_in(2);
  if constexpr (std::is_base_of_v<VelodynePacket, Decoder>) {
    const int banks = Decoder::unit().banks;
    is_dual = is_dual && banks < 4;
    return tests::VelodynePacket{.first_azimuth = random.between(0, 36'000),
                                 .mode = is_dual ? 0x39 : 0x37,
                                 .product = Decoder::unit().product,
                                 .blocks_of_azimuth = is_dual ? 2 * banks : banks,
                                 .banks = banks}
        .bytes();
  } else if constexpr (std::is_base_of_v<HesaiPacket, Decoder>) {
    return tests::HesaiPacket{
        .format = kFormat<Decoder>, .mode = is_dual ? 0x39 : 0x38, .is_dual = is_dual}
        .bytes();
  } else if constexpr (std::is_base_of_v<OusterPacket, Decoder>) {
    return tests::OusterPacket{
        .format = kFormat<Decoder>, .rows = kOusterRows, .first_column = 1'008}
        .bytes();
  } else if constexpr (IsRadar<Decoder>) {
    return tests::Ars548List{.detections = std::vector<tests::Ars548Detection>(random.below(20))}
        .bytes();
  } else if constexpr (IsUltrasonic<Decoder>) {
    return tests::MavlinkDistance{.current_cm = static_cast<std::uint16_t>(random.below(600))}
        .bytes();
  } else {
    return tests::LuxMessage{.points = std::vector<tests::LuxPoint>(20), .flags = 0x402}.bytes();
  }
}

template <typename Decoder>
DecodeStatus decode(Decoder& decoder, const Bytes& bytes) {
  static const std::vector<LaserCorrection> corrections(
      128, LaserCorrection{.azimuth_ticks = 3'000, .range_mm = -10'000});
  if constexpr (std::is_base_of_v<OusterPacket, Decoder>) {
    const auto rows = std::span(corrections).first(kOusterRows);
    return decoder.decode(bytes,
                          {.corrections = rows, .columns_per_turn = 1'024, .column_ns = 97'656});
  } else if constexpr (requires { decoder.decode(bytes, corrections); }) {
    return decoder.decode(bytes, std::span(corrections).first(Decoder::kLayers));
  } else {
    return decoder.decode(bytes);
  }
}

template <typename Decoder>
void expect_points_of_the_format(const Decoder& decoder) {
  constexpr bool kIsOuster = std::is_base_of_v<OusterPacket, Decoder>;
  constexpr std::size_t kLayers = kIsOuster ? kOusterRows : layers_of<Decoder>();
  std::uint32_t count = 0;
  decoder.for_each_point([&](const ScanPoint& point) {
    ASSERT_LT(point.layer, kLayers);
    ASSERT_LT(point.echo, Decoder::kTurns ? 2 : IbeoLux::kMaxEchoes);
    ASSERT_LT(point.azimuth_ticks, Decoder::kTicksPerTurn);
    ASSERT_LE(point.range_mm, kMaxRangeMm);
    ++count;
  });
  EXPECT_EQ(count, decoder.info().point_count);
}

// Any damaged byte is either still a packet or a status, never a crash, and a packet never yields a
// point outside its format.
template <typename Decoder>
void expect_total(tests::Random& random) {
  for (int i = 0; i < tests::effort(10'000, 200); ++i) {
    Bytes bytes = sound_packet<Decoder>(random);
    Decoder decoder;
    if (i == 0) {
      ASSERT_EQ(decode(decoder, bytes), DecodeStatus::kOk);
    }
    for (int flips = random.between(1, 4); flips > 0; --flips) {
      bytes.at(random.below(bytes.size())) = static_cast<std::byte>(random.next());
    }
    if (random.one_in(8)) {
      bytes.resize(random.below(bytes.size()));
    }
    if (decode(decoder, bytes) == DecodeStatus::kOk) {
      expect_points_of_the_format(decoder);
    }
  }
}

TEST(Decoders, AreTotalOnDamagedPackets) {
  tests::Random random(12);
  for_each_format([&]<typename Decoder>(Format /*format*/, std::type_identity<Decoder> /*which*/) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, Decoder::kName);
    expect_total<Decoder>(random);
  });
}

TEST(Decoders, EachHasNamesOfItsOwn) {
  std::set<std::string_view> names;
  std::set<std::string_view> types;
  for_each_format([&]<typename Decoder>(Format format, std::type_identity<Decoder> /*which*/) {
    EXPECT_EQ(format, kFormat<Decoder>);
    EXPECT_EQ(name_of(format), Decoder::kName);
    EXPECT_EQ(ticks_per_turn(format), Decoder::kTicksPerTurn);
    EXPECT_TRUE(names.insert(Decoder::kName).second) << Decoder::kName;
    EXPECT_TRUE(types.insert(Decoder::kDataSheet.type).second) << Decoder::kName;
  });
  EXPECT_EQ(names.size(), kFormatCount);
  EXPECT_EQ(name_of(static_cast<Format>(200)), "");
}

}  // namespace
}  // namespace iog::lidar
