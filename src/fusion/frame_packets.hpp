// A frame's packets, kept until several cores fuse them, or until the frame ends: only then is it
// known which of them were measured together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "intake/intake.hpp"
#include "intake/packet.hpp"

namespace iog::fusion {

// Enough for 40 ms of 128 layers (an OS1-128: 51 packets, 1.3 MB), of two units of 64, or of an
// HDL-64E S3 with two returns (232 packets, 280 KB). Four LUX send some 30 KB.
inline constexpr std::size_t kMaxFrameBytes = 1'572'864;
inline constexpr std::size_t kMaxFramePackets = 1'024;

struct KeptPacket {
  // Of its measurement: by the clock of the poses if its sensor is synchronised, else by the
  // target's.
  std::uint64_t time_us = 0;
  std::uint16_t bytes = 0;
  std::uint8_t sensor = 0;
  // What FrameSlices finds out: whether the time is known on the clock of the poses, in which
  // slice it lies, and with which packets it is fused.
  bool has_time = false;
  std::uint64_t slice = 0;
  std::uint8_t group = 0;
};

class FramePackets {
 public:
  // Whether there is room for the packet. There is for any if none is kept.
  [[nodiscard]] bool fits(const intake::SensorPacket& packet) const;

  // Copies the packet's bytes, and has its points read from there. Only if it fits.
  void keep(const intake::SensorPacket& packet, std::uint64_t time_us);

  void clear();

  // How many points they have.
  [[nodiscard]] std::uint32_t points() const { return points_; }

  // In the order in which they came.
  [[nodiscard]] std::span<KeptPacket> packets() { return std::span(packets_).first(count_); }
  [[nodiscard]] std::span<const KeptPacket> packets() const {
    return std::span(packets_).first(count_);
  }

  // The packet of this number, as it was decoded when it came.
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
