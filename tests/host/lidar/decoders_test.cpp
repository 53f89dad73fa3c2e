// What every decoder of the one list promises, whatever its format.
#include <array>
#include <gtest/gtest.h>
#include <set>
#include <string_view>
#include <type_traits>
#include <vector>

#include "fakes/any_packet.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "intake/packet.hpp"
#include "lidar/scanner_facts.hpp"

namespace iog::lidar {
namespace {

// One or two returns of each beam, all of them corrected where a unit's are.
constexpr std::size_t kOusterRows = 4;

template <typename Decoder>
constexpr std::size_t kLayers = std::is_base_of_v<OusterPacket, Decoder> || IsPoints<Decoder>
                                    ? kOusterRows
                                    : layers_of<Decoder>();

template <typename Decoder>
DecodeStatus decode(Decoder& decoder, std::span<const std::byte> bytes) {
  static const std::vector<LaserCorrection> corrections(
      kLayers<Decoder>, LaserCorrection{.azimuth_ticks = 3'000, .range_mm = -10'000});
  static constexpr std::array<std::int32_t, kOusterRows> kElevations{-3'200, 0, 1, 3'200};
  return intake::decode_with(decoder, bytes,
                             {.corrections = corrections,
                              .elevations = kElevations,
                              .columns_per_turn = 1'024,
                              .column_ns = 97'656});
}

// Any damaged byte is either still a packet or a status, never a crash, and a packet never yields a
// point outside its format.
template <typename Decoder>
void expect_total(tests::Random& random) {
  for (int i = 0; i < tests::effort(10'000, 200); ++i) {
    std::vector<std::byte> bytes = tests::sound_packet<Decoder>(random, kOusterRows);
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
      ASSERT_EQ(tests::broken_law(decoder, kLayers<Decoder>), nullptr);
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
