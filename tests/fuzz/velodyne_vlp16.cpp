// VelodyneVlp16 on two packets, one after the other. A packet that is too short is filled up with
// zeros, so that the length does not hide the rest.
#include "lidar/velodyne_vlp16.hpp"

#include <algorithm>
#include <array>

#include "law.hpp"

namespace iog::fuzz {
namespace {

using Decoder = lidar::VelodyneVlp16;
using Packet = std::array<std::byte, Decoder::kPacketBytes>;

Packet packet_of(std::span<const std::byte> bytes) {
  Packet packet{};
  std::ranges::copy(bytes.first(std::min(bytes.size(), packet.size())), packet.begin());
  return packet;
}

std::uint64_t digest(const Decoder& decoder) {
  std::uint64_t sum = decoder.info().fingerprint;
  std::size_t count = 0;
  decoder.for_each_point([&](const lidar::ScanPoint& point) {
    law(point.azimuth_ticks < Decoder::kTicksPerTurn, "an azimuth is within a turn");
    law(point.layer < Decoder::kElevationsDeg.size(), "a layer has an elevation");
    law(point.echo < 2, "two returns at most");
    sum = sum * 31 + std::uint64_t{point.range_mm} * 7 + std::uint64_t{point.azimuth_ticks} * 5 +
          point.layer + point.echo;
    ++count;
  });
  law(count == Decoder::kPointsPerPacket, "384 points");
  return sum;
}

void check(std::span<const std::byte> first, std::span<const std::byte> second) {
  const Packet before = packet_of(first);
  const Packet packet = packet_of(second);
  Decoder used;
  static_cast<void>(used.decode(before));
  Decoder fresh;
  const lidar::DecodeStatus status = fresh.decode(packet);
  law(used.decode(packet) == status, "the packet before has no influence");
  if (status == lidar::DecodeStatus::kOk) {
    law(digest(fresh) == digest(used), "nor on the points");
  }
  law(fresh.decode(second.first(std::min(second.size(), packet.size() - 1))) ==
          lidar::DecodeStatus::kWrongLength,
      "a shorter packet is refused");
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::wire::ByteReader in(iog::fuzz::input_bytes(data, size));
  const auto first = iog::fuzz::next_piece(in);
  iog::fuzz::check(first, in.bytes(in.remaining()));
  return 0;
}
