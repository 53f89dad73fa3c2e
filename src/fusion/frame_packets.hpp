// A buffer for the packets of a frame. Packets are buffered so that several cores can fuse them in
// parallel. If cells are classified, packets are buffered until the frame ends, because the slices
// are not known until then.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "intake/intake.hpp"
#include "intake/packet.hpp"

namespace iog::fusion {

// The buffer has room for 40 ms of data from a sensor with 128 layers (OS1-128: 51 packets, 1.3
// MB), from two sensors with 64 layers each, or from an HDL-64E S3 with two returns (232 packets,
// 280 KB). Four LUX units send about 30 KB in 40 ms.
inline constexpr std::size_t kMaxFrameBytes = 1'572'864;
inline constexpr std::size_t kMaxFramePackets = 1'024;

struct KeptPacket {
  // The measurement time. If the sensor is synchronised, the time is on the pose source's clock.
  // Otherwise, it is on the target's clock.
  std::uint64_t time_us = 0;
  std::uint16_t bytes = 0;
  std::uint8_t sensor = 0;
  // FrameSlices sets the following members. `has_time` is true if `time_us` is on the pose source's
  // clock. `slice` is the slice that contains this time. Packets of the same group are fused
  // together.
  bool has_time = false;
  std::uint64_t slice = 0;
  std::uint8_t group = 0;
};

class FramePackets {
 public:
  // Returns true if the buffer has room for the packet. An empty buffer has room for any packet.
  [[nodiscard]] bool fits(const intake::SensorPacket& packet) const;

  // Copies the packet and its bytes. The copy's points refer to the copied bytes. Call this
  // function only if fits() returns true.
  void keep(const intake::SensorPacket& packet, std::uint64_t time_us);

  void clear();

  // Returns the number of points in all packets.
  [[nodiscard]] std::uint32_t points() const { return points_; }

  // Returns the packets in order of arrival.
  [[nodiscard]] std::span<KeptPacket> packets() { return std::span(packets_).first(count_); }
  [[nodiscard]] std::span<const KeptPacket> packets() const {
    return std::span(packets_).first(count_);
  }

  // Returns the packet with this number as decoded on arrival.
  [[nodiscard]] const intake::Packet& decoded(std::size_t number) const { return decoded_[number]; }

 private:
  std::size_t count_ = 0;
  std::size_t bytes_used_ = 0;
  std::uint32_t points_ = 0;
  std::array<KeptPacket, kMaxFramePackets> packets_{};
  std::array<intake::Packet, kMaxFramePackets> decoded_{};
  std::array<std::byte, kMaxFrameBytes> bytes_{};
};

}  // namespace iog::fusion
