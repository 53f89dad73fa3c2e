// A frame's packets, kept until it ends: only then is it known which of them were measured
// together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "intake/intake.hpp"
#include "intake/packet.hpp"
#include "vehicle/vehicle.hpp"
#include "window/rules.hpp"

namespace iog::app {

// Enough for a dual-return turn of a VLP-16 (151 packets of 1206 bytes) and a half. Four LUX send
// some 30 KB.
inline constexpr std::size_t kMaxFrameBytes = 262'144;
inline constexpr std::size_t kMaxFramePackets = 512;

// The most cells that a frame with classes marks, so that the groups with hits are not more than
// can be fused.
inline constexpr std::size_t kMaxFrameMarks = window::kGroupBudget;

struct KeptPacket {
  // Of its measurement: by the clock of the poses if its sensor is synchronised, else by the
  // target's.
  std::uint64_t time_us = 0;
  std::uint16_t bytes = 0;
  std::uint8_t sensor = 0;
  // What app::FrameSlices finds out: whether the time is known on the clock of the poses, in which
  // slice it lies, and with which packets it is fused.
  bool has_time = false;
  std::uint64_t slice = 0;
  std::uint8_t group = 0;
};

class FramePackets {
 public:
  // sensors outlive the packets.
  explicit FramePackets(std::span<const vehicle::Sensor> sensors) : sensors_(sensors) {}

  // Whether there is room for the packet, its bytes and all that its points can mark.
  [[nodiscard]] bool fits(const intake::SensorPacket& packet) const;

  // Copies the packet's bytes, and has its points read from there. Only if it fits.
  void keep(const intake::SensorPacket& packet, std::uint64_t time_us);

  void clear();

  // The most cells that their points can mark.
  [[nodiscard]] std::uint64_t marks() const { return marks_; }

  // In the order in which they came.
  [[nodiscard]] std::span<KeptPacket> packets() { return std::span(packets_).first(count_); }

  // The packet of this number, as it was decoded when it came.
  [[nodiscard]] const intake::Packet& decoded(std::size_t number) const { return decoded_[number]; }

 private:
  [[nodiscard]] std::uint64_t marks_of(const intake::SensorPacket& packet) const;

  std::span<const vehicle::Sensor> sensors_;
  std::size_t count_ = 0;
  std::size_t bytes_used_ = 0;
  std::uint64_t marks_ = 0;
  std::array<KeptPacket, kMaxFramePackets> packets_{};
  std::array<intake::Packet, kMaxFramePackets> decoded_{};
  std::array<std::byte, kMaxFrameBytes> bytes_{};
};

}  // namespace iog::app
