// Velodyne VLP-16 data packets: wire bytes to scan points.
//
// One datagram of 1206 bytes, little endian: 12 blocks of an azimuth and 32 ranges, then time,
// return mode and product (docs/spec.md; VLP-16 User Manual 63-9243, chapter 9). A block holds two
// firings of the 16 lasers; only the first has an azimuth. In dual return mode blocks come in pairs
// of one azimuth, the last and the strongest return.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lidar/scan_point.hpp"
#include "wire/byte_order.hpp"

namespace iog::lidar {

class VelodyneVlp16 {
 public:
  static constexpr std::int32_t kTicksPerTurn = 36000;  // 0.01 degree
  // By laser id, which is the order on the wire.
  static constexpr std::array<double, 16> kElevationsDeg{-15, 1, -13, 3,  -11, 5,  -9, 7,
                                                         -7,  9, -5,  11, -3,  13, -1, 15};
  static constexpr std::size_t kPacketBytes = 1206;
  static constexpr std::size_t kBlocks = 12;
  static constexpr std::size_t kBlockBytes = 100;
  static constexpr std::size_t kPointsPerBlock = 32;
  static constexpr std::size_t kPointsPerPacket = kBlocks * kPointsPerBlock;
  // A block lasts 110.592 us, which is 0.8 degrees at the fastest rotation of 20 Hz. If two
  // neighbours are more than 3 degrees apart, the packet is not one sweep.
  static constexpr std::uint32_t kMaxBlockStepTicks = 300;
  // The wire does not say how far the head turns in the last block, and its speed varies by a
  // tenth. So a packet's sector is made this much wider: neighbouring sectors overlap instead of
  // leaving a gap.
  static constexpr std::uint32_t kSeamTicks = 10;

  // Checks the whole packet and keeps a view of it. The view lives as long as the datagram.
  // kOk, kWrongLength, kWrongType or kWrongAngle.
  [[nodiscard]] DecodeStatus decode(std::span<const std::byte> datagram);

  [[nodiscard]] const PacketInfo& info() const { return info_; }

  // Calls visit(const ScanPoint&) for each of the 384 ranges, in wire order. Only after decode()
  // was kOk.
  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    for (std::size_t block = 0; block < kBlocks; ++block) {
      for (std::size_t channel = 0; channel < kPointsPerBlock; ++channel) {
        visit(point(block, channel));
      }
    }
  }

 private:
  using Packet = std::span<const std::byte, kPacketBytes>;

  [[nodiscard]] ScanPoint point(std::size_t block, std::size_t channel) const;
  [[nodiscard]] std::uint32_t range_mm(std::size_t block, std::size_t channel) const;
  [[nodiscard]] DecodeStatus read_azimuths();

  PacketInfo info_;
  std::span<const std::byte> packet_;
  std::array<std::uint16_t, kBlocks> azimuths_{};  // clockwise from forward, as on the wire
  std::array<std::uint16_t, kBlocks> steps_{};     // azimuth gained during the block
  bool is_dual_ = false;
};

}  // namespace iog::lidar
