#include "intake/packet.hpp"

namespace iog::intake {

template <typename Of>
Packet Packet::decode_as(std::span<const std::byte> payload) {
  Packet packet;
  Of& decoder = packet.decoder_.emplace<Of>();
  packet.status_ = decoder.decode(payload);
  packet.info_ = decoder.info();
  return packet;
}

// Without a default: a format that is missing here does not compile.
Packet Packet::decode(lidar::Format format, std::span<const std::byte> payload) {
  switch (format) {
    case lidar::Format::kIbeoLux:
      return decode_as<lidar::IbeoLux>(payload);
    case lidar::Format::kVelodyneVlp16:
      return decode_as<lidar::VelodyneVlp16>(payload);
  }
  return {};  // no format at all
}

}  // namespace iog::intake
