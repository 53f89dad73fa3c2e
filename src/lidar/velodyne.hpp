// Decodes the data packets of Velodyne lidars.
//
// A datagram is 1206 bytes long and little-endian. The datagram contains 12 blocks, followed by the
// time, the return mode and the product (docs/spec.md). Each block contains a flag, an azimuth and
// 32 ranges. The lasers in a block, their firing times and the resolution of the ranges depend on
// the model. VelodyneUnit describes these differences.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lidar/data_sheet.hpp"
#include "lidar/echo_pair.hpp"
#include "lidar/laser.hpp"
#include "lidar/sampling.hpp"
#include "lidar/scan_point.hpp"
#include "lidar/velodyne_bytes.hpp"
#include "lidar/velodyne_look.hpp"
#include "wire/byte_order.hpp"

namespace iog::lidar {

struct VelodyneUnit {
  std::uint8_t layers = 0;
  // The number of blocks that share one azimuth in single return mode. This number is 2 or 4 if the
  // ranges of all lasers do not fit into one block.
  std::uint8_t banks = 1;
  std::uint8_t product = 0;      // byte 1205; has a different meaning if there are two banks
  std::uint8_t old_product = 0;  // value of the same byte in old firmware
  std::uint8_t range_unit_mm = 0;
  bool has_two_returns = true;  // if the unit is configured for it
  std::uint32_t block_ns = 0;   // time from one azimuth to the next
  // `fires_at` contains the firing time of each channel, in units of block_ns / block_parts. Firing
  // times are measured from the moment when the channel's bank begins to fire.
  std::uint32_t block_parts = 1;
  std::array<std::uint8_t, 32> fires_at{};
  // The azimuth of each channel relative to the head, clockwise, in units of 0.01 degrees.
  std::array<std::int16_t, 32> azimuth_offsets{};
  // The time from the measurement of the azimuth until each bank begins to fire, in units of
  // block_ns / block_parts. If all values are zero, all banks fire at the same time.
  std::array<std::uint8_t, 4> bank_fires_at{};

  // Returns the time at which a channel of a bank fires, in units of block_ns / block_parts.
  [[nodiscard]] constexpr std::uint32_t fires_after(std::size_t bank, std::size_t channel) const {
    return std::uint32_t{bank_fires_at[bank]} + fires_at[channel];
  }
  // Returns the number of different times at which banks begin to fire.
  [[nodiscard]] constexpr std::size_t bank_times() const {
    return bank_fires_at == std::array<std::uint8_t, 4>{} ? 1 : banks;
  }
};

// `packets` is the number of packets per turn. The minimum range of the units is 1 m.
constexpr DataSheet data_sheet_of_velodyne(std::string_view type, std::uint32_t packets) {
  return {.type = type, .range_min_mm = 1'000, .max_points_per_scan = packets * 384};
}

class VelodynePacket {
 public:
  static constexpr std::size_t kPacketBytes = velodyne::kPacketBytes;
  static constexpr std::size_t kBlocks = velodyne::kBlocks;
  static constexpr std::size_t kBlockBytes = velodyne::kBlockBytes;
  static constexpr std::size_t kPointsPerBlock = 32;
  static constexpr std::size_t kPointsPerPacket = kBlocks * kPointsPerBlock;
  static constexpr std::int32_t kTicksPerTurn = velodyne::kTurn;
  static constexpr bool kTurns = true;
  // A block takes at most 110.592 us. In this time, the head rotates by at most 0.8 degrees,
  // because the maximum rotation rate is 20 Hz. If two adjacent blocks are more than 3 degrees
  // apart, the packet does not cover a single continuous sweep.
  static constexpr std::uint32_t kMaxBlockStepTicks = 300;
  // Packets do not show how far the head rotates during the last block, and the rotation speed
  // varies by up to a tenth. The sector of a packet is therefore widened by kSeamTicks. As a
  // result, adjacent sectors overlap instead of leaving a gap.
  static constexpr std::uint32_t kSeamTicks = 10;

  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t /*layers*/) {
    return kPointsPerPacket;
  }

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Returns what the packet reveals about the unit. The packet must be valid.
  [[nodiscard]] const VelodyneLook& look() const { return look_; }

  // Makes the view refer to `copy`, which must be a copy of the datagram.
  void move_to(std::span<const std::byte> copy) { packet_ = copy; }

 protected:
  // Checks the whole packet and keeps a view of the datagram.
  [[nodiscard]] DecodeStatus read(const VelodyneUnit& unit, std::span<const std::byte> datagram,
                                  std::span<const LaserCorrection> corrections);

  // The azimuth of each channel relative to the block's azimuth. It consists of the rotation of the
  // head until the channel fires, and the channel's own offset.
  struct Firing {
    std::uint32_t step = 0xFFFF;  // azimuth increment over the block; never 0xFFFF in a packet
    std::array<std::int16_t, kPointsPerBlock> ticks{};  // clockwise from the block's azimuth
  };
  static void turn(const VelodyneUnit& unit, std::size_t bank, std::uint32_t step, Firing& firing) {
    firing.step = step;
    for (std::size_t channel = 0; channel < kPointsPerBlock; ++channel) {
      const std::uint32_t turned =
          (step * unit.fires_after(bank, channel) + unit.block_parts / 2) / unit.block_parts;
      firing.ticks[channel] = static_cast<std::int16_t>(unit.azimuth_offsets[channel] +
                                                        static_cast<std::int32_t>(turned));
    }
  }

  // Returns the raw range of a channel.
  [[nodiscard]] static std::uint32_t range_at(std::span<const std::byte, kBlockBytes> block,
                                              std::size_t channel) {
    return wire::load_le16(block.subspan(4 + 3 * channel).first<2>());
  }

  [[nodiscard]] std::span<const std::byte, kBlockBytes> bytes_of(std::size_t block) const {
    return packet_.subspan(block * kBlockBytes).first<kBlockBytes>();
  }

  // The properties that all points of a block share, computed once per block.
  struct Block {
    std::span<const std::byte, kBlockBytes> bytes;
    std::span<const std::byte, kBlockBytes> other;  // contains the other echo of each point
    std::span<const LaserCorrection> corrections;   // corrections of the channels; may be empty
    std::int32_t azimuth;
    std::uint8_t first_layer;
    std::uint8_t echo;
  };

  [[nodiscard]] std::uint32_t step(std::size_t block) const { return steps_[block]; }

  // Returns the number of blocks that share one azimuth. This number is `banks`, or twice `banks`
  // in dual return mode.
  [[nodiscard]] std::size_t blocks_of_firing(const VelodyneUnit& unit) const {
    return look_.is_dual ? 2U * unit.banks : unit.banks;
  }

  [[nodiscard]] Block block(const VelodyneUnit& unit, std::size_t number) const {
    const std::size_t first_layer = number % unit.banks * kPointsPerBlock;
    return {.bytes = bytes_of(number),
            .other = bytes_of(look_.is_dual ? number ^ unit.banks : number),
            .corrections = corrections_.empty() ? corrections_ : corrections_.subspan(first_layer),
            .azimuth = azimuths_[number],
            .first_layer = static_cast<std::uint8_t>(first_layer),
            .echo = static_cast<std::uint8_t>(look_.is_dual ? number / unit.banks % 2 : 0)};
  }

 private:
  [[nodiscard]] DecodeStatus read_ends(const VelodyneUnit& unit) const;
  [[nodiscard]] DecodeStatus read_azimuths(const VelodyneUnit& unit);
  [[nodiscard]] DecodeStatus read_steps(std::size_t blocks_of_azimuth);

  PacketInfo info_;
  VelodyneLook look_;
  std::span<const std::byte> packet_;
  std::span<const LaserCorrection> corrections_;
  std::array<std::uint16_t, kBlocks> azimuths_{};  // raw azimuths, clockwise from straight ahead
  std::array<std::uint16_t, kBlocks> steps_{};     // azimuth increment to the next azimuth
};

template <const VelodyneUnit& kUnit>
class VelodyneDecoder : public VelodynePacket {
 public:
  static constexpr std::size_t kLayers = kUnit.layers;

  [[nodiscard]] static constexpr const VelodyneUnit& unit() { return kUnit; }

  // Checks the packet and keeps a view of the datagram. The view is valid only while the datagram
  // and the corrections exist. `corrections` contains one correction per layer, or is empty.
  // Returns kOk, kWrongLength, kWrongType, kWrongAngle or kOtherUnit.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram,
                                    std::span<const LaserCorrection> corrections = {}) {
    return read(kUnit, datagram, corrections);
  }

  // Calls visit(const ScanPoint&) for each of the 384 ranges, in wire order. Requires decode() ==
  // kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    if (look().is_dual) {
      for_each_point_of<true>(visit);
    } else {
      for_each_point_of<false>(visit);
    }
  }

  // Calls visit(const ScanPoint&) for the first echo of each sampled beam. Requires decode() ==
  // kOk.
  template <typename Visit>
  void for_each_sample(const Sampling& sampling, Visit&& visit) const {
    Turns turns;
    std::size_t number = kBlocks;  // of the last sample's block, which many samples share
    Block its = block(kUnit, 0);
    const Firing* turned = nullptr;
    for_each_place(sampling, [&](std::size_t first, std::size_t bank, std::size_t channel) {
      if (first + bank != number) {
        number = first + bank;
        its = block(kUnit, number);
        turned = &turns.of(bank, step(first));
      }
      visit(look().is_dual ? point<true>(its, *turned, channel)
                           : point<false>(its, *turned, channel));
    });
  }

  // Calls visit(std::uint32_t) for the raw range of each sampled point. Like std::for_each(), the
  // function returns visit, so that the compiler can keep counters inside visit in registers.
  // Requires decode() == kOk.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(const Sampling& sampling, Visit visit) const {
    for_each_place(sampling, [&](std::size_t first, std::size_t bank, std::size_t channel) {
      visit(range_at(bytes_of(first + bank), channel));
    });
    return visit;
  }

 private:
  // Calls visit(first block of the firing, bank, channel) for each sampled point. A block contains
  // one firing, a part of a firing, or several firings. Each echo has its own blocks.
  template <typename Visit>
  void for_each_place(const Sampling& sampling, Visit&& visit) const {
    constexpr std::size_t kFirings = kLayers < kPointsPerBlock ? kPointsPerBlock / kLayers : 1;
    const std::size_t blocks = blocks_of_firing(kUnit);
    sampling.for_each_firing(kBlocks / blocks * kFirings, [&](std::size_t firing) {
      for (const std::uint8_t layer : sampling.layers) {
        visit(firing / kFirings * blocks, layer / kPointsPerBlock,
              firing % kFirings * kLayers + layer % kPointsPerBlock);
      }
    });
  }

  // A cache of the latest firings. If the head rotates at a constant speed, only two different
  // azimuth steps occur between blocks, and they differ by 0.01 degrees.
  class Turns {
   public:
    [[nodiscard]] const Firing& of(std::size_t bank, std::uint32_t step) {
      Firing& firing = firings_[bank % kTimes][step % 2];
      if (firing.step != step) {
        turn(kUnit, bank % kTimes, step, firing);
      }
      return firing;
    }

   private:
    static constexpr std::size_t kTimes = kUnit.bank_times();
    std::array<std::array<Firing, 2>, kTimes> firings_;
  };

  // If the unit is known at compile time, the compiler optimises most of this function away,
  // including the division.
  template <bool kIsDual>
  [[nodiscard]] static ScanPoint point(const Block& block, const Firing& firing,
                                       std::size_t channel) {
    ScanPoint point;
    point.layer = static_cast<std::uint8_t>((block.first_layer + channel) % kLayers);
    point.range_mm = range_mm(block.bytes, channel);
    if constexpr (kIsDual) {
      point.echo = block.echo;
      point.range_mm = range_of_echo(point.range_mm, range_mm(block.other, channel), point.echo);
    }
    std::int32_t azimuth = kTicksPerTurn - block.azimuth - firing.ticks[channel];
    if (!block.corrections.empty()) {
      const LaserCorrection& laser = block.corrections[channel % kLayers];
      azimuth += laser.azimuth_ticks;
      point.range_mm = corrected_range_mm(point.range_mm, laser.range_mm);
    }
    // The azimuth is at most one turn, the rotation is at most 3 degrees and the offset is at most
    // 34.2 degrees, so the sum has to be wrapped only once.
    azimuth += azimuth < 0 ? kTicksPerTurn : 0;
    azimuth -= azimuth >= kTicksPerTurn ? kTicksPerTurn : 0;
    point.azimuth_ticks = static_cast<std::uint16_t>(azimuth);
    return point;
  }

  [[nodiscard]] static std::uint32_t range_mm(std::span<const std::byte, kBlockBytes> block,
                                              std::size_t channel) {
    return range_at(block, channel) * kUnit.range_unit_mm;
  }

  template <bool kIsDual, typename Visit>
  void for_each_point_of(Visit&& visit) const {
    Turns turns;
    for (std::size_t number = 0; number < kBlocks; ++number) {
      const Block its = block(kUnit, number);
      const Firing& firing = turns.of(number % kUnit.banks, step(number));
      for (std::size_t channel = 0; channel < kPointsPerBlock; ++channel) {
        visit(point<kIsDual>(its, firing, channel));
      }
    }
  }
};

}  // namespace iog::lidar
