#include "lidar/velodyne_look.hpp"

namespace iog::lidar {
namespace {

std::uint32_t azimuth_of(std::span<const std::byte> packet, std::size_t block) {
  return velodyne::word_at(packet, block * velodyne::kBlockBytes + 2) % velodyne::kTurn;
}

// One bank, two that alternate, or four.
std::uint8_t banks_of(std::span<const std::byte> packet) {
  const auto flag = [&](std::size_t block) {
    return velodyne::word_at(packet, block * velodyne::kBlockBytes);
  };
  if (flag(1) != velodyne::kBankFlags[1]) {
    return 1;
  }
  return flag(2) == velodyne::kBankFlags[2] ? 4 : 2;
}

}  // namespace

// A unit with two banks has no mode byte. With two returns, it repeats each azimuth four times.
VelodyneLook look_at(std::span<const std::byte, velodyne::kPacketBytes> packet) {
  VelodyneLook look;
  look.banks = banks_of(packet);
  look.mode = velodyne::byte_at(packet, velodyne::kModeOffset);
  look.product = velodyne::byte_at(packet, velodyne::kProductOffset);
  look.is_dual = look.banks == 2 ? azimuth_of(packet, 0) == azimuth_of(packet, 2)
                                 : look.mode == velodyne::kModeDual;
  const std::size_t blocks_of_azimuth = look.banks * std::size_t{look.is_dual ? 2U : 1U};
  const std::size_t last = velodyne::kBlocks - blocks_of_azimuth;
  look.time_us = wire::load_le32(packet.subspan<velodyne::kTimeOffset, 4>()) % velodyne::kHourUs;
  look.azimuth = azimuth_of(packet, 0);
  look.gain = velodyne::gained(look.azimuth, azimuth_of(packet, last));
  look.steps = static_cast<std::uint32_t>(last / blocks_of_azimuth);
  return look;
}

}  // namespace iog::lidar
