// How fast frames may leave: an even rate, and short bursts.
//
// A grid is up to 1024 tiles, one frame each, all finished in the same moment. Sent at once they
// overrun the socket buffer of an ordinary receiver (212992 bytes on Linux hold some 90 of them),
// and datagrams have no way to ask for patience. So frames are paid for with credit that grows by
// kFramesPerWindow every kWindowUs and never exceeds kBurstFrames:
//
//   8 frames per 250 us of 1538 bytes on the wire (1514, FCS, preamble, gap) are 394 Mbit/s, below
//   the 400 Mbit/s that the i.MX6Q's Ethernet sustains (erratum ERR004512), and a complete grid
//   leaves within 34 ms of the 40 ms between two; the burst is one tick of the sleeping loop (1
//   ms), 48 KiB, a quarter of that socket buffer.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::imx6 {

class TransmitShaper {
 public:
  static constexpr std::uint32_t kWindowUs = 250;
  static constexpr std::uint32_t kFramesPerWindow = 8;
  static constexpr std::uint32_t kBurstFrames = 32;

  // How many frames may leave now. now_us must not go back.
  std::size_t allowed(std::uint64_t now_us) {
    const std::uint64_t elapsed_us = now_us - window_began_us_;
    if (elapsed_us >= kForgetUs) {
      credit_ = kBurstFrames;
      window_began_us_ = now_us;
      return credit_;
    }
    // Less than kForgetUs, so the division is one of 32 bits.
    const std::uint32_t windows = static_cast<std::uint32_t>(elapsed_us) / kWindowUs;
    window_began_us_ += std::uint64_t{windows} * kWindowUs;
    credit_ += windows * kFramesPerWindow;
    credit_ = credit_ > kBurstFrames ? kBurstFrames : credit_;
    return credit_;
  }

  // Pays for frames that left; at most what allowed() returned.
  void spend(std::size_t frames) { credit_ -= static_cast<std::uint32_t>(frames); }

 private:
  // After this long the credit is full, whatever was spent, and nothing is lost by starting anew.
  // Not sooner: a loop that comes every 999 us must not lose the 249 us that made no window yet.
  static constexpr std::uint32_t kForgetUs = 2 * kBurstFrames / kFramesPerWindow * kWindowUs;

  std::uint64_t window_began_us_ = 0;
  std::uint32_t credit_ = kBurstFrames;
};

}  // namespace iog::imx6
