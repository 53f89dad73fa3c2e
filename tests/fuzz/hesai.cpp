// Hesai: the first byte chooses the unit, and the rest is filled up with zeros, so that the length
// does not hide what follows.
#include <algorithm>
#include <array>
#include <vector>

#include "law.hpp"
#include "lidar/formats.hpp"

namespace iog::fuzz {
namespace {

constexpr std::array<lidar::LaserCorrection, 128> kCorrections{
    {{521, 0}, {-521, 30'000}, {32'767, -30'000}, {-32'768, 1}}};

template <typename Decoder>
void check(bool is_longest, std::span<const std::byte> bytes) {
  constexpr lidar::HesaiUnit kUnit = Decoder::unit();
  const std::size_t packet_bytes = kUnit.bytes + (is_longest ? kUnit.may_follow_bytes : 0);
  const auto corrections = std::span(kCorrections).first(Decoder::kLayers);
  std::vector<std::byte> packet(packet_bytes);
  std::ranges::copy(bytes.first(std::min(bytes.size(), packet.size())), packet.begin());
  Decoder decoder;
  if (decoder.decode(packet, corrections) == lidar::DecodeStatus::kOk) {
    std::uint32_t count = 0;
    decoder.for_each_point([&](const lidar::ScanPoint& point) {
      law(point.azimuth_ticks < Decoder::kTicksPerTurn, "an azimuth is within a turn");
      law(point.layer < Decoder::kLayers, "a layer is one of the unit");
      law(point.echo < 2, "two returns at most");
      ++count;
    });
    law(count == decoder.info().point_count, "as many points as it says");
  }
  packet.resize(packet.size() - 5);
  law(decoder.decode(packet, corrections) == lidar::DecodeStatus::kWrongLength,
      "a shorter packet is refused");
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::wire::ByteReader in(iog::fuzz::input_bytes(data, size));
  const std::uint8_t choice = in.u8();
  const auto packet = in.bytes(in.remaining());
  const bool is_longest = choice < 128;
  switch (choice % 7U) {
    case 0:
      iog::fuzz::check<iog::lidar::HesaiPandar40p>(is_longest, packet);
      break;
    case 1:
      iog::fuzz::check<iog::lidar::HesaiPandar64>(is_longest, packet);
      break;
    case 2:
      iog::fuzz::check<iog::lidar::HesaiQt64>(is_longest, packet);
      break;
    case 3:
      iog::fuzz::check<iog::lidar::HesaiQt128>(is_longest, packet);
      break;
    case 4:
      iog::fuzz::check<iog::lidar::HesaiXt16>(is_longest, packet);
      break;
    case 5:
      iog::fuzz::check<iog::lidar::HesaiXt32>(is_longest, packet);
      break;
    default:
      iog::fuzz::check<iog::lidar::HesaiXt32m>(is_longest, packet);
      break;
  }
  return 0;
}
