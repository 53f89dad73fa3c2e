// A buffer descriptor of the ENET's DMA, in the legacy form of 8 bytes (IMX6DQRM, ENET, "Legacy
// buffer descriptors"), in the little-endian order that ECR.DBSWP selects. The enhanced form would
// add checksum offload and time stamps, which this firmware does not use.
#pragma once

#include <cstddef>
#include <cstdint>

#include "machine.hpp"
#include "memory/l2_cache.hpp"

namespace iog::imx6 {

struct Descriptor {
  std::uint16_t length;
  std::uint16_t flags;
  std::uint32_t buffer;
};
static_assert(sizeof(Descriptor) == 8);

namespace receive_flag {
inline constexpr std::uint16_t kEmpty = 1u << 15;     // E: the controller owns it
inline constexpr std::uint16_t kWrap = 1u << 13;      // W: last descriptor of the ring
inline constexpr std::uint16_t kLast = 1u << 11;      // L: the frame ends in this buffer
inline constexpr std::uint16_t kTooLong = 1u << 5;    // LG
inline constexpr std::uint16_t kNonOctet = 1u << 4;   // NO
inline constexpr std::uint16_t kBadCrc = 1u << 2;     // CR
inline constexpr std::uint16_t kOverrun = 1u << 1;    // OV
inline constexpr std::uint16_t kTruncated = 1u << 0;  // TR
}  // namespace receive_flag

namespace transmit_flag {
inline constexpr std::uint16_t kReady = 1u << 15;  // R: the controller owns it
inline constexpr std::uint16_t kWrap = 1u << 13;   // W
inline constexpr std::uint16_t kLast = 1u << 11;   // L
inline constexpr std::uint16_t kCrc = 1u << 10;    // TC: the controller appends the FCS
}  // namespace transmit_flag

// The descriptor format for rings.hpp. The owner bit is in `flags`, and the length is stored
// separately, so the length may be stored first.
struct DescriptorFormat {
  using Descriptor = imx6::Descriptor;
  using Memory = L2Cache;
  // Four LUX at 25 Hz send about 1000 frames of 1500 bytes per second, and a Velodyne sends 1500
  // frames. The ring therefore holds 100 ms of the traffic of all these sensors, which is longer
  // than the slowest pass of the loop.
  static constexpr std::size_t kReceiveFrames = 256;
  // A buffer has room for the longest frame (1518 bytes), and its size aligns every buffer to
  // 64-byte bursts.
  static constexpr std::size_t kReceiveBytes = 2048;

  static void place(Descriptor& descriptor, std::uint32_t buffer) {
    machine::store(descriptor.buffer, buffer);
  }
  static void empty(Descriptor& descriptor) { machine::store(descriptor.length, std::uint16_t{0}); }
  static void give(Descriptor& descriptor, std::uint32_t /*buffer*/, bool is_last) {
    machine::store(
        descriptor.flags,
        static_cast<std::uint16_t>(receive_flag::kEmpty | (is_last ? receive_flag::kWrap : 0)));
  }
  static bool is_filled(const Descriptor& descriptor) {
    return (machine::load(descriptor.flags) & receive_flag::kEmpty) == 0;
  }

  static void place_free(Descriptor& descriptor, std::uint32_t buffer, bool is_last) {
    machine::store(descriptor.length, std::uint16_t{0});
    machine::store(descriptor.flags, is_last ? transmit_flag::kWrap : std::uint16_t{0});
    machine::store(descriptor.buffer, buffer);
  }
  static void set_length(Descriptor& descriptor, std::size_t bytes) {
    machine::store(descriptor.length, static_cast<std::uint16_t>(bytes));
  }
  static void send(Descriptor& descriptor) {
    const unsigned wrap = machine::load(descriptor.flags) & transmit_flag::kWrap;
    machine::store(descriptor.flags,
                   static_cast<std::uint16_t>(transmit_flag::kReady | transmit_flag::kLast |
                                              transmit_flag::kCrc | wrap));
  }
  static bool is_sent(const Descriptor& descriptor) {
    return (machine::load(descriptor.flags) & transmit_flag::kReady) == 0;
  }
};

}  // namespace iog::imx6
