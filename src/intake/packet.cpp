#include "intake/packet.hpp"

#include <type_traits>

namespace iog::intake {
namespace {

template <typename Decoder>
concept TakesUnit = requires(Decoder& decoder, const lidar::Unit& unit) {
  decoder.decode(std::span<const std::byte>(), unit);
};

template <typename Decoder>
concept TakesCorrections = requires(Decoder& decoder, const lidar::Unit& unit) {
  decoder.decode(std::span<const std::byte>(), unit.corrections);
};

// Each decoder wants to know as much of the unit as its packets leave open.
template <typename Decoder>
lidar::DecodeStatus decode_with(Decoder& decoder, std::span<const std::byte> payload,
                                const lidar::Unit& unit) {
  if constexpr (TakesUnit<Decoder>) {
    return decoder.decode(payload, unit);
  } else if constexpr (TakesCorrections<Decoder>) {
    return decoder.decode(payload, unit.corrections);
  } else {
    return decoder.decode(payload);
  }
}

}  // namespace

Packet Packet::decode(lidar::Format format, std::span<const std::byte> payload,
                      const lidar::Unit& unit) {
  Packet packet;
  lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    Decoder& decoder = packet.decoder_.emplace<Decoder>();
    packet.status_ = decode_with(decoder, payload, unit);
    packet.info_ = decoder.info();
  });
  return packet;
}

const lidar::VelodyneLook* Packet::velodyne_look() const {
  const lidar::VelodyneLook* look = nullptr;
  with_decoder(*this, [&]<typename Decoder>(const Decoder& decoder) {
    if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
      look = &decoder.look();
    }
  });
  return look;
}

void Packet::move_to(std::span<const std::byte> copy) {
  with_decoder(*this, [copy](auto& decoder) { decoder.move_to(copy); });
}

}  // namespace iog::intake
