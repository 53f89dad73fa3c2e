// Splits the packets of a frame into parts that any core may fuse. A part holds packets of one
// slice, in order of arrival. The parts are sorted by slice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fusion/frame_packets.hpp"
#include "fusion/frame_slices.hpp"

namespace iog::fusion {

struct FramePart {
  std::uint16_t first = 0;  // range in FrameParts::packets_of()
  std::uint16_t end = 0;
  std::uint8_t group = 0;  // KeptPacket::group of all its packets

  [[nodiscard]] std::uint32_t packets() const { return std::uint32_t{end} - first; }
};

class FrameParts {
 public:
  // The most parts fused in one round: slightly more than the packets of four LUX, so that no core
  // waits long for the last part.
  static constexpr std::size_t kMostOfARound = 24;

  // Deals out packets with groups 0 to groups - 1 or kNowhere. A part gets one `parts`-th of all
  // bytes or little more, or less if its slice ends earlier. parts is at most kMostOfARound.
  void deal(std::span<const KeptPacket> packets, std::size_t groups, std::size_t parts);

  // The next round: the parts of as many of the next slices as fit. Empty if all were dealt. No
  // slice is split between rounds.
  [[nodiscard]] std::span<const FramePart> next_round();

  // The numbers of a part's packets in the frame.
  [[nodiscard]] std::span<const std::uint16_t> packets_of(const FramePart& part) const {
    return std::span(order_).subspan(part.first, std::size_t{part.end} - part.first);
  }

 private:
  // Each part of a group except the last has a full share of the bytes.
  static constexpr std::size_t kMaxGroups = kMaxSlices + 1;
  static constexpr std::size_t kMaxParts = kMostOfARound + kMaxGroups;

  void deal_group(std::span<const KeptPacket> packets, std::uint8_t group, std::size_t share);
  void end_part(std::size_t first, std::size_t end, std::uint8_t group);

  std::size_t ordered_ = 0;
  std::size_t count_ = 0;
  std::size_t dealt_ = 0;  // parts given to rounds
  std::array<FramePart, kMaxParts> parts_{};
  std::array<std::uint16_t, kMaxFramePackets> order_{};
};

}  // namespace iog::fusion
