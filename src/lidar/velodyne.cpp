#include "lidar/velodyne.hpp"

#include <algorithm>

#include "lidar/fingerprint.hpp"

namespace iog::lidar {

using velodyne::word_at;

DecodeStatus VelodynePacket::read(const VelodyneUnit& unit, std::span<const std::byte> datagram,
                                  std::span<const LaserCorrection> corrections) {
  *this = VelodynePacket{};
  if (datagram.size() != kPacketBytes) {
    return DecodeStatus::kWrongLength;
  }
  packet_ = datagram;
  corrections_ = corrections.size() == unit.layers ? corrections : corrections_;
  look_ = look_at(datagram.first<kPacketBytes>());
  DecodeStatus status = read_ends(unit);
  if (status == DecodeStatus::kOk) {
    status = read_azimuths(unit);
  }
  if (status != DecodeStatus::kOk) {
    return status;
  }
  info_.point_count = kPointsPerPacket;
  const std::size_t azimuths = kBlocks / unit.banks / (look_.is_dual ? 2 : 1);
  const std::uint32_t begin_us = wire::load_le32(packet_.subspan(velodyne::kTimeOffset).first<4>());
  info_.sweep = {.begin_us = begin_us,
                 .end_us = begin_us + (azimuths * std::uint64_t{unit.block_ns} + 500) / 1000,
                 .turns_right = true,
                 .is_of_hour = true,
                 .is_of_packet = true};
  info_.fingerprint =
      fingerprint(packet_.subspan(velodyne::kTimeOffset), fingerprint(packet_.first<4>()));
  return DecodeStatus::kOk;
}

// Checks the flags of the blocks and, unless the unit is an HDL-64E, mode and product.
DecodeStatus VelodynePacket::read_ends(const VelodyneUnit& unit) const {
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const std::uint16_t flag = word_at(packet_, block * kBlockBytes);
    if (flag != velodyne::kBankFlags[block % unit.banks]) {
      const auto* const other = std::ranges::find(velodyne::kBankFlags, flag);
      return other != velodyne::kBankFlags.end() ? DecodeStatus::kOtherUnit
                                                 : DecodeStatus::kWrongType;
    }
  }
  if (unit.banks == 2) {
    return DecodeStatus::kOk;
  }
  if (look_.mode != velodyne::kModeStrongest && look_.mode != velodyne::kModeLast &&
      !(look_.mode == velodyne::kModeDual && unit.has_two_returns)) {
    return DecodeStatus::kWrongType;
  }
  return look_.product == unit.product || look_.product == unit.old_product
             ? DecodeStatus::kOk
             : DecodeStatus::kOtherUnit;
}

DecodeStatus VelodynePacket::read_azimuths(const VelodyneUnit& unit) {
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const std::uint16_t azimuth = word_at(packet_, block * kBlockBytes + 2);
    if (azimuth > kTicksPerTurn) {  // captures of 2012 to 2014 contain 36000
      return DecodeStatus::kWrongAngle;
    }
    azimuths_[block] = azimuth == kTicksPerTurn ? std::uint16_t{0} : azimuth;
  }
  return read_steps(std::size_t{unit.banks} * (look_.is_dual ? 2 : 1));
}

// Finds how far the head turns from each azimuth to the next. The last step repeats the one before
// it.
DecodeStatus VelodynePacket::read_steps(std::size_t blocks_of_azimuth) {
  std::uint32_t swept = 0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const std::size_t first = block - block % blocks_of_azimuth;
    if (azimuths_[block] != azimuths_[first]) {
      return DecodeStatus::kWrongAngle;
    }
    const std::size_t next = first + blocks_of_azimuth;
    if (next < kBlocks) {
      const std::int32_t step = azimuths_[next] - azimuths_[first];
      steps_[block] = static_cast<std::uint16_t>(step < 0 ? step + kTicksPerTurn : step);
    } else {
      steps_[block] = steps_[first - 1];
    }
    if (steps_[block] > kMaxBlockStepTicks) {
      return DecodeStatus::kWrongAngle;
    }
    swept += block == first ? std::uint32_t{steps_[block]} : 0U;
  }
  // The wire counts clockwise. So counter-clockwise, the sector begins where the sweep ends.
  constexpr std::uint32_t kTurn = kTicksPerTurn;
  swept += kSeamTicks;
  const std::uint32_t last = (azimuths_[0] + swept) % kTurn;
  info_.sector.first_ticks = static_cast<std::uint16_t>((kTurn - last) % kTurn);
  info_.sector.width_ticks = static_cast<std::uint16_t>(swept);
  return DecodeStatus::kOk;
}

}  // namespace iog::lidar
