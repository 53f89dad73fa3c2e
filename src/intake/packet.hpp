// The header and scan points of a decoded packet of any format.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "lidar/formats.hpp"
#include "lidar/sampling.hpp"
#include "lidar/scan_point.hpp"
#include "lidar/unit.hpp"

namespace iog::intake {

template <typename Decoder>
concept TakesUnit = requires(Decoder& decoder, const lidar::Unit& unit) {
  decoder.decode(std::span<const std::byte>(), unit);
};

template <typename Decoder>
concept TakesCorrections = requires(Decoder& decoder, const lidar::Unit& unit) {
  decoder.decode(std::span<const std::byte>(), unit.corrections);
};

// Decodes the payload.
template <typename Decoder>
[[nodiscard]] lidar::DecodeStatus decode_with(Decoder& decoder, std::span<const std::byte> payload,
                                              const lidar::Unit& unit) {
  if constexpr (TakesUnit<Decoder>) {
    return decoder.decode(payload, unit);
  } else if constexpr (TakesCorrections<Decoder>) {
    return decoder.decode(payload, unit.corrections);
  } else {
    return decoder.decode(payload);
  }
}

class Packet {
 public:
  // The payload and the unit's corrections must outlive the packet.
  [[nodiscard]] static Packet decode(lidar::Format format, std::span<const std::byte> payload,
                                     const lidar::Unit& unit = {}) {
    Packet packet;
    lidar::with_decoder(format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
      Decoder& decoder = packet.decoder_.emplace<Decoder>();
      packet.status_ = decode_with(decoder, payload, unit);
      packet.info_ = decoder.info();
    });
    return packet;
  }

  // If the packet is not valid, use only status() and the number of points.
  [[nodiscard]] lidar::DecodeStatus status() const { return status_; }
  [[nodiscard]] bool is_sound() const { return status_ == lidar::DecodeStatus::kOk; }
  [[nodiscard]] const lidar::PacketInfo& info() const { return info_; }

  // Calls visit(const ScanPoint&) for each point of a valid packet, in wire order.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    with_decoder(*this, [&](const auto& decoder) { decoder.for_each_point(visit); });
  }

  // Calls visit(const ScanPoint&) for the sampled points of a spinning unit (lidar/sampling.hpp).
  template <typename Visit>
  void for_each_sample(const lidar::Sampling& sampling, Visit&& visit) const {
    with_decoder(*this, [&](const auto& decoder) {
      if constexpr (requires { decoder.for_each_sample(sampling, visit); }) {
        decoder.for_each_sample(sampling, visit);
      }
    });
  }

  // Calls visit(std::uint32_t) for the raw ranges of a valid packet, and then returns `visit`. For
  // a spinning unit, visits only the ranges of the sampled points. For other units, visits all
  // ranges.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(const lidar::Sampling& sampling, Visit visit) const {
    with_decoder(*this, [&](const auto& decoder) {
      if constexpr (requires { decoder.for_each_range(sampling, visit); }) {
        visit = decoder.for_each_range(sampling, visit);
      } else {
        visit = decoder.for_each_range(visit);
      }
    });
    return visit;
  }

  // Returns the properties of the unit, as found in a valid Velodyne packet. Returns null for other
  // packets.
  [[nodiscard]] const lidar::VelodyneLook* velodyne_look() const {
    const lidar::VelodyneLook* look = nullptr;
    with_decoder(*this, [&]<typename Decoder>(const Decoder& decoder) {
      if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
        look = &decoder.look();
      }
    });
    return look;
  }

  // Makes the packet read its points from `copy`, which must be a copy of the payload.
  void move_to(std::span<const std::byte> copy) {
    with_decoder(*this, [copy](auto& decoder) { decoder.move_to(copy); });
  }

 private:
  // Calls visit(decoder) with the packet's decoder. `std::visit()` cannot be used because it needs
  // abort() from the C++ library, which the target does not have.
  template <typename Self, typename Visit>
  static void with_decoder(Self& self, Visit&& visit) {
    const auto if_it_is = [&](auto* decoder) {
      if (decoder != nullptr) {
        visit(*decoder);
      }
    };
    [&]<std::size_t... kPlace>(std::index_sequence<kPlace...> /*places*/) {
      (if_it_is(std::get_if<kPlace>(&self.decoder_)), ...);
    }
    (std::make_index_sequence<std::variant_size_v<lidar::AnyDecoder>>());
  }

  lidar::DecodeStatus status_ = lidar::DecodeStatus::kWrongType;
  lidar::PacketInfo info_;
  lidar::AnyDecoder decoder_;
};

}  // namespace iog::intake
