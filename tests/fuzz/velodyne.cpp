// Every Velodyne decoder that there is, on two packets, one after the other, and what tells their
// units apart. A packet that is too short is filled up with zeros, so that the length does not hide
// the rest.
#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <vector>

#include "law.hpp"
#include "lidar/formats.hpp"
#include "lidar/velodyne_identity.hpp"

namespace iog::fuzz {
namespace {

using VelodyneBytes = std::array<std::byte, lidar::VelodynePacket::kPacketBytes>;

VelodyneBytes packet_of(std::span<const std::byte> bytes) {
  VelodyneBytes packet{};
  std::ranges::copy(bytes.first(std::min(bytes.size(), packet.size())), packet.begin());
  return packet;
}

template <typename Decoder>
std::uint64_t digest(const Decoder& decoder) {
  std::uint64_t sum = decoder.info().fingerprint;
  std::size_t count = 0;
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    law(point.azimuth_ticks < Decoder::kTicksPerTurn, "an azimuth is within a turn");
    law(point.layer < Decoder::kLayers, "a layer is a laser");
    law(point.echo < 2, "two returns at most");
    sum = sum * 31 + std::uint64_t{point.range_mm} * 7 + std::uint64_t{point.azimuth_ticks} * 5 +
          point.layer + point.echo;
    ++count;
  });
  law(count == Decoder::kPointsPerPacket, "384 points");
  return sum;
}

template <typename Decoder>
void check_decoder(std::span<const std::byte> before, std::span<const std::byte> packet) {
  const std::vector<lidar::LaserCorrection> corrections(
      Decoder::kLayers, lidar::LaserCorrection{.azimuth_ticks = -3'000, .range_mm = 10'000});
  for (const auto& lasers : {std::span<const lidar::LaserCorrection>(), std::span(corrections)}) {
    Decoder used;
    static_cast<void>(used.decode(before, lasers));
    Decoder fresh;
    const lidar::DecodeStatus status = fresh.decode(packet, lasers);
    law(used.decode(packet, lasers) == status, "the packet before has no influence");
    if (status == lidar::DecodeStatus::kOk) {
      law(digest(fresh) == digest(used), "nor on the points");
    }
    law(fresh.decode(packet.first(packet.size() - 1)) == lidar::DecodeStatus::kWrongLength,
        "a shorter packet is refused");
  }
}

void check(std::span<const std::byte> before, std::span<const std::byte> packet) {
  lidar::FormatSet velodynes;
  lidar::for_each_format(
      [&]<typename Decoder>(lidar::Format format, std::type_identity<Decoder> /*which*/) {
        if constexpr (std::is_base_of_v<lidar::VelodynePacket, Decoder>) {
          check_decoder<Decoder>(before, packet);
          velodynes.add(format);
        }
      });
  lidar::VelodyneIdentity identity;
  for (const auto& bytes : {before, packet, before, packet}) {
    const lidar::FormatSet possible = identity.add(bytes);
    lidar::for_each_format([&](lidar::Format format, auto /*decoder*/) {
      law(!possible.has(format) || velodynes.has(format), "no other maker's format is possible");
    });
  }
}

}  // namespace
}  // namespace iog::fuzz

// Two pieces of the input are two packets.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::wire::ByteReader in(iog::fuzz::input_bytes(data, size));
  const auto before = iog::fuzz::packet_of(iog::fuzz::next_piece(in));
  const auto packet = iog::fuzz::packet_of(in.bytes(in.remaining()));
  iog::fuzz::check(before, packet);
  return 0;
}
