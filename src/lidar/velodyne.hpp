// Velodyne data packets: what the units of the family share, and the one decoder for all of them.
//
// One datagram of 1206 bytes, little endian: 12 blocks of a flag, an azimuth and 32 ranges, then
// time, return mode and product (docs/spec.md). Units differ in what a block holds: which lasers,
// when each of them fires, how long a unit of range is. VelodyneUnit says it, and a decoder is made
// of such a table by the compiler.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lidar/echo_pair.hpp"
#include "lidar/laser.hpp"
#include "lidar/scan_point.hpp"
#include "wire/byte_order.hpp"

namespace iog::lidar {

struct VelodyneUnit {
  std::uint8_t layers = 0;
  // Blocks that share one azimuth when each beam has one return: 2 where a block is too short for
  // all lasers.
  std::uint8_t banks = 1;
  std::uint8_t product = 0;      // byte 1205; with two banks that byte says something else
  std::uint8_t old_product = 0;  // the same byte of old firmware
  std::uint8_t range_unit_mm = 0;
  std::uint32_t block_ns = 0;  // from one azimuth to the next
  // A channel fires so many parts of that time after its block's azimuth was taken.
  std::uint32_t block_parts = 1;
  std::array<std::uint8_t, 32> fires_at{};
  // Clockwise, 0.01 degrees: to add to the direction in which the unit looks.
  std::array<std::int16_t, 32> azimuth_offsets{};
};

class VelodynePacket {
 public:
  static constexpr std::size_t kPacketBytes = 1206;
  static constexpr std::size_t kBlocks = 12;
  static constexpr std::size_t kBlockBytes = 100;
  static constexpr std::size_t kPointsPerBlock = 32;
  static constexpr std::size_t kPointsPerPacket = kBlocks * kPointsPerBlock;
  static constexpr std::int32_t kTicksPerTurn = 36000;  // 0.01 degree
  static constexpr bool kTurns = true;
  // A block lasts at most 110.592 us, which is 0.8 degrees at the fastest rotation of 20 Hz. If two
  // neighbours are more than 3 degrees apart, the packet is not one sweep.
  static constexpr std::uint32_t kMaxBlockStepTicks = 300;
  // The wire does not say how far the head turns in the last block, and its speed varies by a
  // tenth. So a packet's sector is made this much wider: neighbouring sectors overlap instead of
  // leaving a gap.
  static constexpr std::uint32_t kSeamTicks = 10;

  [[nodiscard]] const PacketInfo& info() const { return info_; }

 protected:
  // Checks the whole packet and keeps a view of it.
  [[nodiscard]] DecodeStatus read(const VelodyneUnit& unit, std::span<const std::byte> datagram,
                                  std::span<const LaserCorrection> corrections);

  // Inline, because it is asked for each point: of a unit that the compiler knows, little is left.
  [[nodiscard]] ScanPoint point(const VelodyneUnit& unit, std::size_t block,
                                std::size_t channel) const {
    const std::size_t bank = block & (unit.banks - 1U);
    ScanPoint point;
    point.layer = static_cast<std::uint8_t>((bank * kPointsPerBlock + channel) % unit.layers);
    point.range_mm = range_mm(unit, block, channel);
    if (is_dual_) {
      point.echo = static_cast<std::uint8_t>(block / unit.banks % 2);
      point.range_mm =
          range_of_echo(point.range_mm, range_mm(unit, block ^ unit.banks, channel), point.echo);
    }
    std::int32_t clockwise =
        azimuths_[block] + unit.azimuth_offsets[channel] +
        static_cast<std::int32_t>((steps_[block] * unit.fires_at[channel] + unit.block_parts / 2) /
                                  unit.block_parts);
    if (!corrections_.empty()) {
      const LaserCorrection& laser = corrections_[point.layer];
      clockwise -= laser.azimuth_ticks;
      point.range_mm = corrected_range_mm(point.range_mm, laser.range_mm);
    }
    // An azimuth below a turn, 3 degrees of turning and at most 34.2 of offsets: one turn off.
    clockwise += clockwise < 0 ? kTicksPerTurn : 0;
    clockwise -= clockwise >= kTicksPerTurn ? kTicksPerTurn : 0;
    point.azimuth_ticks =
        static_cast<std::uint16_t>(clockwise == 0 ? 0 : kTicksPerTurn - clockwise);
    return point;
  }

 private:
  [[nodiscard]] std::uint32_t range_mm(const VelodyneUnit& unit, std::size_t block,
                                       std::size_t channel) const {
    return std::uint32_t{
               wire::load_le16(packet_.subspan(block * kBlockBytes + 4 + 3 * channel).first<2>())} *
           unit.range_unit_mm;
  }

  [[nodiscard]] DecodeStatus read_ends(const VelodyneUnit& unit);
  [[nodiscard]] DecodeStatus read_azimuths(const VelodyneUnit& unit);
  [[nodiscard]] DecodeStatus read_steps(std::size_t blocks_of_azimuth);

  PacketInfo info_;
  std::span<const std::byte> packet_;
  std::span<const LaserCorrection> corrections_;
  std::array<std::uint16_t, kBlocks> azimuths_{};  // clockwise from forward, as on the wire
  std::array<std::uint16_t, kBlocks> steps_{};     // azimuth gained until the next one
  bool is_dual_ = false;
};

template <const VelodyneUnit& kUnit>
class VelodyneDecoder : public VelodynePacket {
 public:
  static constexpr std::size_t kLayers = kUnit.layers;

  [[nodiscard]] static constexpr const VelodyneUnit& unit() { return kUnit; }

  // The view lives as long as the datagram and the corrections, of which there is one for each
  // layer, or none. kOk, kWrongLength, kWrongType, kWrongAngle or kOtherUnit.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram,
                                    std::span<const LaserCorrection> corrections = {}) {
    return read(kUnit, datagram, corrections);
  }

  // Calls visit(const ScanPoint&) for each of the 384 ranges, in wire order. Only after decode()
  // was kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    for (std::size_t block = 0; block < kBlocks; ++block) {
      for (std::size_t channel = 0; channel < kPointsPerBlock; ++channel) {
        visit(point(kUnit, block, channel));
      }
    }
  }
};

}  // namespace iog::lidar
