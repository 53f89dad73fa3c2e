// Ouster on a packet of a small unit, or of one whose packets may be another's: the first byte
// chooses profile and mode, and the rest is filled up with zeros, so that the length does not hide
// what follows.
#include "lidar/ouster.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "law.hpp"

namespace iog::fuzz {
namespace {

constexpr std::array<lidar::LaserCorrection, 64> kCorrections{
    {{397, 0}, {-23'040, -30'000}, {23'040, 30'000}, {-1, 1}}};

template <typename Decoder>
void check(unsigned mode, std::span<const std::byte> bytes, std::size_t rows = 4) {
  const lidar::Unit unit{.corrections = std::span(kCorrections).first(rows),
                         .columns_per_turn = static_cast<std::uint16_t>(512U << (mode % 3)),
                         .column_ns = 195'312U >> (mode / 3 % 4)};
  std::vector<std::byte> packet(Decoder::packet_bytes(rows));
  std::ranges::copy(bytes.first(std::min(bytes.size(), packet.size())), packet.begin());
  Decoder decoder;
  if (decoder.decode(packet, unit) == lidar::DecodeStatus::kOk) {
    std::uint32_t count = 0;
    decoder.for_each_point([&](const lidar::ScanPoint& point) {
      law(point.azimuth_ticks < Decoder::kTicksPerTurn, "an azimuth is within a turn");
      law(point.layer < rows, "a layer is one of the unit");
      law(point.echo < 2, "two returns at most");
      law(point.range_mm <= lidar::kMaxRangeMm, "a range has 20 bits, corrected or not");
      ++count;
    });
    law(count == decoder.info().point_count && count > 0, "as many points as it says");
    law(decoder.info().sector.first_ticks < Decoder::kTicksPerTurn &&
            decoder.info().sector.width_ticks <= Decoder::kTicksPerTurn,
        "a sector is within a turn");
  }
  packet.pop_back();
  law(decoder.decode(packet, unit) == lidar::DecodeStatus::kWrongLength,
      "a shorter packet is refused");
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::wire::ByteReader in(iog::fuzz::input_bytes(data, size));
  const std::uint8_t choice = in.u8();
  const auto packet = in.bytes(in.remaining());
  const unsigned mode = choice / 5U;
  switch (choice % 5) {
    case 0:
      iog::fuzz::check<iog::lidar::OusterLegacy>(mode, packet);
      break;
    case 1:
      iog::fuzz::check<iog::lidar::OusterRng15>(mode, packet);
      break;
    case 2:
      iog::fuzz::check<iog::lidar::OusterRng19>(mode, packet);
      break;
    case 3:
      iog::fuzz::check<iog::lidar::OusterRng19Dual>(mode, packet);
      break;
    default:
      iog::fuzz::check<iog::lidar::OusterRng15>(mode, packet, 64);
      break;
  }
  return 0;
}
