// Limits the transmit rate with a token bucket. Each frame takes one token.
//
// A grid has up to 1024 tiles of one frame each, which are all ready at the same time. If all
// frames were sent at once, they would overrun the socket buffer of an ordinary receiver (212992
// bytes on Linux, about 90 frames), and datagrams have no flow control. The bucket therefore gains
// kFramesPerWindow tokens every kWindowUs, and holds at most kBurstFrames tokens.
//
//   Sending 8 frames of 1538 bytes on the wire (1514, FCS, preamble, gap) per 250 us needs 394
//   Mbit/s, below the 400 Mbit/s that the i.MX6Q's Ethernet sustains (erratum ERR004512). A
//   complete grid is sent within 34 ms, and grids are 40 ms apart. The burst covers one tick of the
//   sleeping loop (1 ms) and has 48 KiB, a quarter of the receiver's socket buffer.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::board {

class TransmitShaper {
 public:
  static constexpr std::uint32_t kWindowUs = 250;
  static constexpr std::uint32_t kFramesPerWindow = 8;
  static constexpr std::uint32_t kBurstFrames = 32;

  // Returns the number of frames that may be sent now. `now_us` must not decrease.
  std::size_t allowed(std::uint64_t now_us) {
    const std::uint64_t elapsed_us = now_us - window_began_us_;
    if (elapsed_us >= kForgetUs) {
      tokens_ = kBurstFrames;
      window_began_us_ = now_us;
      return tokens_;
    }
    // The elapsed time is less than kForgetUs, so a 32-bit division is sufficient.
    const std::uint32_t windows = static_cast<std::uint32_t>(elapsed_us) / kWindowUs;
    window_began_us_ += std::uint64_t{windows} * kWindowUs;
    tokens_ += windows * kFramesPerWindow;
    tokens_ = tokens_ > kBurstFrames ? kBurstFrames : tokens_;
    return tokens_;
  }

  // Takes a token for each sent frame. `frames` must be at most allowed().
  void spend(std::size_t frames) { tokens_ -= static_cast<std::uint32_t>(frames); }

 private:
  // After this time, the bucket is full in any case, so restarting the windows loses no tokens. A
  // shorter time would lose tokens, because a loop that runs every 999 us has 249 us left over from
  // unfinished windows.
  static constexpr std::uint32_t kForgetUs = 2 * kBurstFrames / kFramesPerWindow * kWindowUs;

  std::uint64_t window_began_us_ = 0;
  std::uint32_t tokens_ = kBurstFrames;
};

}  // namespace iog::board
