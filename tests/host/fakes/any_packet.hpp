// A sound packet of any format, and what every format promises of its points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "fakes/ars548_list.hpp"
#include "fakes/hesai_packet.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/mavlink_distance.hpp"
#include "fakes/ouster_packet.hpp"
#include "fakes/points_packet.hpp"
#include "fakes/random.hpp"
#include "fakes/velodyne_packet.hpp"
#include "lidar/scanner_facts.hpp"

namespace iog::tests {

// One or two returns of each beam; of an Ouster with so many rows that turns as its packets say.
template <typename Decoder>
std::vector<std::byte> sound_packet(Random& random, std::size_t ouster_rows = 4) {
  bool is_dual = random.one_in(2);
  if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
    const int banks = Decoder::unit().banks;
    is_dual = is_dual && banks < 4;
    return VelodynePacket{.first_azimuth = random.between(0, 36'000),
                          .mode = is_dual ? 0x39 : 0x37,
                          .product = Decoder::unit().product,
                          .blocks_of_azimuth = is_dual ? 2 * banks : banks,
                          .banks = banks}
        .bytes();
  } else if constexpr (std::is_base_of_v<lidar::HesaiPacket, Decoder>) {
    return HesaiPacket{
        .format = lidar::kFormat<Decoder>, .mode = is_dual ? 0x39 : 0x38, .is_dual = is_dual}
        .bytes();
  } else if constexpr (std::is_base_of_v<lidar::OusterPacket, Decoder>) {
    return OusterPacket{.format = lidar::kFormat<Decoder>,
                        .rows = static_cast<int>(ouster_rows),
                        .first_column = 1'008}
        .bytes();
  } else if constexpr (lidar::IsPoints<Decoder>) {
    return PointsPacket{.flags = random.below(2) == 0 ? 0 : 3,
                        .points = std::vector<SentPoint>(random.below(20))}
        .bytes();
  } else if constexpr (lidar::IsRadar<Decoder>) {
    return Ars548List{.detections = std::vector<Ars548Detection>(random.below(20))}.bytes();
  } else if constexpr (lidar::IsUltrasonic<Decoder>) {
    return MavlinkDistance{.current_cm = static_cast<std::uint16_t>(random.below(600))}.bytes();
  } else {
    return LuxMessage{.points = std::vector<LuxPoint>(20), .flags = 0x402}.bytes();
  }
}

template <typename Decoder>
constexpr std::uint32_t most_echoes() {
  if constexpr (lidar::IsRadar<Decoder> || lidar::IsUltrasonic<Decoder>) {
    return 1;
  } else {
    return Decoder::kTurns ? 2 : lidar::IbeoLux::kMaxEchoes;
  }
}

// What a packet that was decoded, of a unit with so many layers, breaks of it; nullptr: nothing.
template <typename Decoder>
const char* broken_law(const Decoder& decoder, std::size_t layers) {
  const lidar::PacketInfo info = decoder.info();
  std::uint32_t count = 0;
  const char* broken = nullptr;
  const auto law = [&](bool holds, const char* text) { broken = holds ? broken : text; };
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    law(point.azimuth_ticks < Decoder::kTicksPerTurn, "an azimuth is within a turn");
    law(point.layer < layers, "a layer is one of the unit");
    law(point.echo < most_echoes<Decoder>(), "no more echoes than the format has");
    law(point.range_mm <= lidar::kMaxRangeMm, "a range is one that a unit may have");
    ++count;
  });
  law(count == info.point_count, "as many points as it says");
  if constexpr (Decoder::kTurns || lidar::IsRadar<Decoder> || lidar::IsUltrasonic<Decoder>) {
    law(count <= Decoder::points_of_packet(layers), "no more points than there are places");
  }
  law(info.sector.first_ticks < Decoder::kTicksPerTurn &&
          info.sector.width_ticks <= Decoder::kTicksPerTurn,
      "a sector is within a turn");
  return broken;
}

}  // namespace iog::tests
