// How fast frames may leave: a token bucket, one token a frame.
//
// A grid is up to 1024 tiles, one frame each, all finished in the same moment. Sent at once they
// overrun the socket buffer of an ordinary receiver (212992 bytes on Linux hold some 90 of them),
// and datagrams have no flow control. So a frame takes a token. The bucket gains kFramesPerWindow
// tokens every kWindowUs and holds at most kBurstFrames:
//
//   8 frames per 250 us of 1538 bytes on the wire (1514, FCS, preamble, gap) are 394 Mbit/s, below
//   the 400 Mbit/s that the i.MX6Q's Ethernet sustains (erratum ERR004512), and a complete grid
//   leaves within 34 ms of the 40 ms between two; the burst is one tick of the sleeping loop (1
//   ms), 48 KiB, a quarter of that socket buffer.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::board {

class TransmitShaper {
 public:
  static constexpr std::uint32_t kWindowUs = 250;
  static constexpr std::uint32_t kFramesPerWindow = 8;
  static constexpr std::uint32_t kBurstFrames = 32;

  // Tokens in the bucket: how many frames may leave now. now_us must not go back.
  std::size_t allowed(std::uint64_t now_us) {
    const std::uint64_t elapsed_us = now_us - window_began_us_;
    if (elapsed_us >= kForgetUs) {
      tokens_ = kBurstFrames;
      window_began_us_ = now_us;
      return tokens_;
    }
    // Less than kForgetUs, so the division is one of 32 bits.
    const std::uint32_t windows = static_cast<std::uint32_t>(elapsed_us) / kWindowUs;
    window_began_us_ += std::uint64_t{windows} * kWindowUs;
    tokens_ += windows * kFramesPerWindow;
    tokens_ = tokens_ > kBurstFrames ? kBurstFrames : tokens_;
    return tokens_;
  }

  // Takes a token for each frame that left; at most what allowed() returned.
  void spend(std::size_t frames) { tokens_ -= static_cast<std::uint32_t>(frames); }

 private:
  // After this long the bucket is full, whatever was taken, and nothing is lost by starting anew.
  // Not sooner: a loop that comes every 999 us must not lose the 249 us that made no window yet.
  static constexpr std::uint32_t kForgetUs = 2 * kBurstFrames / kFramesPerWindow * kWindowUs;

  std::uint64_t window_began_us_ = 0;
  std::uint32_t tokens_ = kBurstFrames;
};

}  // namespace iog::board
