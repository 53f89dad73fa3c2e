#include "lidar/velodyne_vlp16.hpp"

#include <algorithm>

#include "lidar/fingerprint.hpp"

namespace iog::lidar {
namespace {

constexpr std::size_t kTimeOffset = 1200;
constexpr std::size_t kModeOffset = 1204;
constexpr std::size_t kProductOffset = 1205;
constexpr std::uint16_t kBlockFlag = 0xEEFF;
constexpr std::uint8_t kModeStrongest = 0x37;
constexpr std::uint8_t kModeLast = 0x38;
constexpr std::uint8_t kModeDual = 0x39;
// Firmware before 3.0.29 calls the VLP-16 0x21, the id of the HDL-32E.
constexpr std::uint8_t kProductOldFirmware = 0x21;
constexpr std::uint8_t kProductVlp16 = 0x22;
constexpr std::uint32_t kMillimetresPerUnit = 2;
constexpr std::uint16_t kTurn = VelodyneVlp16::kTicksPerTurn;

std::uint16_t word_at(std::span<const std::byte> packet, std::size_t offset) {
  return wire::load_le16(packet.subspan(offset).first<2>());
}

std::uint8_t byte_at(std::span<const std::byte> packet, std::size_t offset) {
  return wire::load_u8(packet.subspan(offset).first<1>());
}

}  // namespace

DecodeStatus VelodyneVlp16::decode(std::span<const std::byte> datagram) {
  *this = VelodyneVlp16{};
  if (datagram.size() != kPacketBytes) {
    return DecodeStatus::kWrongLength;
  }
  packet_ = datagram;
  const std::uint8_t mode = byte_at(packet_, kModeOffset);
  const std::uint8_t product = byte_at(packet_, kProductOffset);
  const bool is_known_mode = mode == kModeStrongest || mode == kModeLast || mode == kModeDual;
  if (!is_known_mode || (product != kProductOldFirmware && product != kProductVlp16)) {
    return DecodeStatus::kWrongType;
  }
  is_dual_ = mode == kModeDual;
  const DecodeStatus status = read_azimuths();
  if (status != DecodeStatus::kOk) {
    return status;
  }
  info_.point_count = kPointsPerPacket;
  info_.fingerprint = fingerprint(packet_.subspan(kTimeOffset), fingerprint(packet_.first<4>()));
  return DecodeStatus::kOk;
}

// Each block's azimuth, and how far the head turns during the block: to the next block of another
// azimuth, or for the last one as far as the one before it turned.
DecodeStatus VelodyneVlp16::read_azimuths() {
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if (word_at(packet_, block * kBlockBytes) != kBlockFlag) {
      return DecodeStatus::kWrongType;
    }
    const std::uint16_t azimuth = word_at(packet_, block * kBlockBytes + 2);
    if (azimuth > kTurn) {  // captures of 2012 to 2014 show 36000 itself
      return DecodeStatus::kWrongAngle;
    }
    azimuths_[block] = azimuth == kTurn ? std::uint16_t{0} : azimuth;
  }
  const std::size_t stride = is_dual_ ? 2 : 1;
  std::uint32_t swept = 0;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    if (block + stride < kBlocks) {
      const std::int32_t step = azimuths_[block + stride] - azimuths_[block];
      steps_[block] = static_cast<std::uint16_t>(step < 0 ? step + kTurn : step);
    } else {
      steps_[block] = steps_[block - stride];
    }
    if (steps_[block] > kMaxBlockStepTicks ||
        (is_dual_ && block % 2 == 1 && azimuths_[block] != azimuths_[block - 1])) {
      return DecodeStatus::kWrongAngle;
    }
    swept += block % stride == 0 ? std::uint32_t{steps_[block]} : 0U;
  }
  // Clockwise on the wire: the sweep ends where, counter-clockwise, its sector begins.
  swept += kSeamTicks;
  const std::uint32_t last = (azimuths_[0] + swept) % kTurn;
  info_.sector.first_ticks = static_cast<std::uint16_t>((kTurn - last) % kTurn);
  info_.sector.width_ticks = static_cast<std::uint16_t>(swept);
  return DecodeStatus::kOk;
}

std::uint32_t VelodyneVlp16::range_mm(std::size_t block, std::size_t channel) const {
  return word_at(packet_, block * kBlockBytes + 4 + 3 * channel) * kMillimetresPerUnit;
}

ScanPoint VelodyneVlp16::point(std::size_t block, std::size_t channel) const {
  const std::size_t laser = channel % kElevationsDeg.size();
  const std::size_t firing = channel / kElevationsDeg.size();
  ScanPoint point;
  point.layer = static_cast<std::uint8_t>(laser);
  point.range_mm = range_mm(block, channel);
  if (is_dual_) {
    // Of the pair the nearer return is the first echo. A beam with one return shows it twice; the
    // second is no echo of its own.
    const std::uint32_t other = range_mm(block ^ 1U, channel);
    const std::uint32_t nearer = std::min(point.range_mm, other);
    const std::uint32_t farther = std::max(point.range_mm, other);
    const bool has_two = nearer != 0 && nearer != farther;
    point.echo = static_cast<std::uint8_t>(block % 2);
    if (point.echo == 0) {
      point.range_mm = has_two ? nearer : farther;
    } else {
      point.range_mm = has_two ? farther : 0;
    }
  }
  // Laser j of firing s fires 2.304 j + 55.296 s us into the block's 110.592 us: (j + 24 s) / 48.
  const auto turned = (steps_[block] * (static_cast<std::uint32_t>(laser) +
                                        24 * static_cast<std::uint32_t>(firing)) +
                       24) /
                      48;
  const std::uint32_t clockwise = (azimuths_[block] + turned) % kTurn;
  point.azimuth_ticks = static_cast<std::uint16_t>((kTurn - clockwise) % kTurn);
  return point;
}

}  // namespace iog::lidar
