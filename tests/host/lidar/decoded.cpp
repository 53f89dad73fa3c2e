#include "lidar/decoded.hpp"

#include "intake/packet.hpp"

namespace iog::lidar {

Decoded::Decoded(std::span<const std::byte> bytes, Format format, const Unit& unit) {
  const auto packet = intake::Packet::decode(format, bytes, unit);
  status = packet.status();
  info = packet.info();
  if (packet.is_sound()) {
    packet.for_each_point([this](const ScanPoint& point) { points.push_back(point); });
  }
}

}  // namespace iog::lidar
