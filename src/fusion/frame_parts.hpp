// The packets of a frame in parts that any core may fuse: packets of one slice that came one after
// the other. The parts follow one another by their slices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fusion/frame_packets.hpp"
#include "fusion/frame_slices.hpp"

namespace iog::fusion {

struct FramePart {
  std::uint16_t first = 0;  // its packets, in FrameParts::packets_of()
  std::uint16_t end = 0;
  std::uint8_t group = 0;  // KeptPacket::group of all of them

  [[nodiscard]] std::uint32_t packets() const { return std::uint32_t{end} - first; }
};

class FrameParts {
 public:
  // As many as are fused in one round: some more than the packets of four LUX, so that no
  // core waits long for the last part.
  static constexpr std::size_t kMostOfARound = 24;

  // Deals out packets that are in groups 0 to groups - 1 or nowhere. Such a part of all bytes, at
  // least a kMostOfARound-th, is a part, or little more, unless its slice ends before.
  void deal(std::span<const KeptPacket> packets, std::size_t groups, std::size_t parts);

  // The next round: the parts of the next slices, as many as it has room for; empty when all were
  // dealt. No slice is in two rounds.
  [[nodiscard]] std::span<const FramePart> next_round();

  // The numbers of a part's packets among all.
  [[nodiscard]] std::span<const std::uint16_t> packets_of(const FramePart& part) const {
    return std::span(order_).subspan(part.first, std::size_t{part.end} - part.first);
  }

 private:
  // Each part but the last of its group has a full share of the bytes.
  static constexpr std::size_t kMaxGroups = kMaxSlices + 1;
  static constexpr std::size_t kMaxParts = kMostOfARound + kMaxGroups;

  void deal_group(std::span<const KeptPacket> packets, std::uint8_t group, std::size_t share);
  void end_part(std::size_t first, std::size_t end, std::uint8_t group);

  std::size_t ordered_ = 0;
  std::size_t count_ = 0;
  std::size_t dealt_ = 0;  // to rounds
  std::array<FramePart, kMaxParts> parts_{};
  std::array<std::uint16_t, kMaxFramePackets> order_{};
};

}  // namespace iog::fusion
