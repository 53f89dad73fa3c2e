// A buffer descriptor of the ENET's DMA, in the legacy form of 8 bytes (IMX6DQRM, ENET, "Legacy
// buffer descriptors"), in the little-endian order that ECR.DBSWP selects. The enhanced form would
// add checksum offload and time stamps, which nothing here uses.
#pragma once

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
inline constexpr std::uint16_t kWrap = 1u << 13;      // W: the ring begins again after this one
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

// How one descriptor changes hands; TransmitRing does the same for several at once. First
// everything that was stored before, buffer and length included, reaches memory. Then the flags
// with the owner bit are stored, last of all. Code that wakes the controller afterwards calls
// drain_stores() once more, so that it finds the bit.
inline void hand_over(Descriptor& descriptor, std::uint16_t flags_with_owner, L2Cache& cache) {
  cache.drain_stores();
  machine::store(descriptor.flags, flags_with_owner);
}

}  // namespace iog::imx6
