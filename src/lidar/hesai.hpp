// Decodes the data packets of Hesai Pandar, PandarXT, PandarQT and QT128 lidars.
//
// A datagram is little-endian and consists of a header, blocks, and a tail (docs/spec.md). The
// header contains the number of lasers and the number of blocks. The tail contains the time, the
// return mode and a byte that identifies the manufacturer. Each block contains an azimuth and one
// range per laser. Packets of a Pandar40P have no header. Instead, each block begins with a flag.
// The azimuth is clockwise from straight ahead. In dual return mode, the blocks form pairs with the
// same azimuth. On some units, the nearer return is in the first block of a pair, on others in the
// second, so the decoder compares the ranges. HesaiUnit describes all other differences between
// units.
//
// The azimuth of a point is the azimuth of its block plus the azimuth offset of its laser. At 10
// Hz, the head rotates by up to 0.5 degrees while the lasers of a block fire. Like the
// manufacturer's own conversion, the decoder ignores this rotation.
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
#include "wire/byte_order.hpp"

namespace iog::lidar {

// Describes a unit. Offsets (*_at) are relative to the start of the packet. Times are in ns.
// `stamped_block_ns` is the time from the packet's timestamp to the last block, or to the first
// block if is_first_stamped is set. `first_laser_ns` and last_laser_ns are the times from the start
// of a block to its first and last laser. `firing_ns` is the time between two firings.
struct HesaiUnit {
  std::array<std::uint8_t, 2> model{};  // bytes 2 and 3 of the header
  std::uint8_t flags = 0;               // byte 11 of a long header; also implied by the length
  std::size_t header_bytes = 0;         // 0 if each block has a flag instead of a header
  std::size_t counts_at = 0;            // offset of the numbers of lasers and blocks in the header
  std::size_t distance_unit_at = 0;     // offset in the header
  std::uint32_t distance_unit_mm = 4;
  std::size_t flag_bytes = 0;  // number of bytes before each azimuth
  std::size_t blocks = 0;
  std::size_t lasers = 0;
  std::size_t bank_lasers = 0;  // number of lasers in each of the first two banks, which alternate
  std::size_t channel_bytes = 0;
  std::size_t bank_at = 0;   // offset in the tail, as below; specifies which bank fires first
  std::size_t speed_at = 0;  // offset of the rpm; used if a packet may contain a single firing
  std::size_t mode_at = 0;
  std::size_t utc_at = 0;
  std::size_t time_at = 0;
  std::size_t maker_at = 0;
  std::size_t bytes = 0;             // without the trailing part
  std::size_t may_follow_bytes = 0;  // trailing part: a sequence number or a signature
  bool is_first_stamped = false;     // the timestamp refers to the first block, not to the last one
  std::int64_t stamped_block_ns = 0;
  std::int64_t first_laser_ns = 0;
  std::int64_t last_laser_ns = 0;
  std::int64_t firing_ns = 0;

  // Returns the offset of a block's azimuth.
  [[nodiscard]] constexpr std::size_t block_at(std::size_t block) const {
    return header_bytes + flag_bytes + block * (flag_bytes + 2 + lasers * channel_bytes);
  }
};

class HesaiPacket {
 public:
  static constexpr std::int32_t kTicksPerTurn = 36'000;  // 0.01 degrees
  static constexpr bool kTurns = true;
  // At 20 Hz, a firing covers at most 1.2 degrees of azimuth. If two adjacent blocks are more than
  // 3 degrees apart, the packet does not cover a single continuous sweep.
  static constexpr std::uint32_t kMaxBlockStepTicks = 300;
  // Packets do not show how far the head rotates during the last block (see
  // VelodynePacket::kSeamTicks).
  static constexpr std::uint32_t kSeamTicks = 10;
  static constexpr std::size_t kMaxBlocks = 10;

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Makes the view refer to `copy`, which must be a copy of the datagram.
  void move_to(std::span<const std::byte> copy) { packet_ = copy; }

 protected:
  // Checks the whole packet and keeps a view of the datagram.
  [[nodiscard]] DecodeStatus read(const HesaiUnit& unit, std::span<const std::byte> datagram,
                                  std::span<const LaserCorrection> corrections);

  [[nodiscard]] bool is_dual() const { return is_dual_; }

  // This function is inlined because it is called for every point. If the unit is known at compile
  // time, the compiler optimises most of the function away.
  [[nodiscard]] ScanPoint point(const HesaiUnit& unit, std::size_t block,
                                std::size_t channel) const {
    ScanPoint point;
    point.layer = static_cast<std::uint8_t>(channel);
    point.range_mm = range_mm(unit, block, channel);
    if (is_dual_) {
      point.echo = static_cast<std::uint8_t>(block % 2);
      point.range_mm =
          range_of_echo(point.range_mm, range_mm(unit, block ^ 1U, channel), point.echo);
    }
    std::int32_t azimuth = kTicksPerTurn - azimuths_[block];
    if (!corrections_.empty()) {
      const LaserCorrection& laser = corrections_[channel];
      azimuth += laser.azimuth_ticks;
      point.range_mm = corrected_range_mm(point.range_mm, laser.range_mm);
    }
    // The azimuth is above 0 and at most one turn, and the 16-bit offset is below one turn, so the
    // sum has to be wrapped only once.
    azimuth += azimuth < 0 ? kTicksPerTurn : 0;
    azimuth -= azimuth >= kTicksPerTurn ? kTicksPerTurn : 0;
    point.azimuth_ticks = static_cast<std::uint16_t>(azimuth);
    return point;
  }

  // A raw range.
  [[nodiscard]] std::uint32_t range_at(const HesaiUnit& unit, std::size_t block,
                                       std::size_t channel) const {
    const std::size_t at = unit.block_at(block) + 2 + channel * unit.channel_bytes;
    return wire::load_le16(packet_.subspan(at).first<2>());
  }

 private:
  [[nodiscard]] std::uint32_t range_mm(const HesaiUnit& unit, std::size_t block,
                                       std::size_t channel) const {
    return range_at(unit, block, channel) * unit.distance_unit_mm;
  }

  [[nodiscard]] std::uint8_t byte_at(std::size_t offset) const;
  [[nodiscard]] std::uint16_t half_at(std::size_t offset) const;
  [[nodiscard]] std::uint32_t word_at(std::size_t offset) const;
  [[nodiscard]] bool has_header_of(const HesaiUnit& unit) const;
  [[nodiscard]] bool has_flags_of(const HesaiUnit& unit) const;
  [[nodiscard]] bool read_mode(const HesaiUnit& unit);
  [[nodiscard]] std::uint32_t step_by_speed(const HesaiUnit& unit) const;
  [[nodiscard]] DecodeStatus read_azimuths(const HesaiUnit& unit);
  [[nodiscard]] std::uint64_t stamp_us(const HesaiUnit& unit) const;
  void read_times(const HesaiUnit& unit);

  PacketInfo info_;
  std::span<const std::byte> packet_;
  std::span<const LaserCorrection> corrections_;
  std::array<std::uint16_t, kMaxBlocks> azimuths_{};  // raw azimuths, clockwise from straight ahead
  bool is_dual_ = false;
};

template <const HesaiUnit& kUnit>
class HesaiDecoder : public HesaiPacket {
 public:
  static constexpr std::size_t kLayers = kUnit.lasers;

  [[nodiscard]] static constexpr const HesaiUnit& unit() { return kUnit; }
  [[nodiscard]] static constexpr std::size_t points_of_packet(std::size_t /*layers*/) {
    return kUnit.blocks * kUnit.lasers;
  }

  // Checks the packet and keeps a view of the datagram. The view is valid only while the datagram
  // and the corrections exist. `corrections` contains one correction per laser, or is empty.
  // Returns kOk, kWrongLength, kWrongType or kWrongAngle.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram,
                                    std::span<const LaserCorrection> corrections = {}) {
    return read(kUnit, datagram, corrections);
  }

  // Calls visit(const ScanPoint&) for each range, in wire order. Requires decode() == kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    for (std::size_t block = 0; block < kUnit.blocks; ++block) {
      for (std::size_t channel = 0; channel < kUnit.lasers; ++channel) {
        visit(point(kUnit, block, channel));
      }
    }
  }

  // Calls visit(const ScanPoint&) for the first echo of each sampled beam. Requires decode() ==
  // kOk.
  template <typename Visit>
  void for_each_sample(const Sampling& sampling, Visit&& visit) const {
    for_each_place(sampling, [&](std::size_t block, std::uint8_t layer) {
      visit(point(kUnit, block, layer));
    });
  }

  // Calls visit(std::uint32_t) for the raw range of each sampled point, and returns visit. Requires
  // decode() == kOk.
  template <typename Visit>
  [[nodiscard]] Visit for_each_range(const Sampling& sampling, Visit visit) const {
    for_each_place(sampling, [&](std::size_t block, std::uint8_t layer) {
      visit(range_at(kUnit, block, layer));
    });
    return visit;
  }

 private:
  // Calls visit(block, layer) for each sampled point.
  template <typename Visit>
  void for_each_place(const Sampling& sampling, Visit&& visit) const {
    const std::size_t echoes = is_dual() ? 2 : 1;
    sampling.for_each_firing(kUnit.blocks / echoes, [&](std::size_t firing) {
      for (const std::uint8_t layer : sampling.layers) {
        visit(firing * echoes, layer);
      }
    });
  }
};

}  // namespace iog::lidar
