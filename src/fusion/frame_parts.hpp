// Splits the packets of a frame into parts. Any core can fuse any part. A part contains packets of
// one slice, in order of arrival. Parts are sorted by slice.
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
  std::uint8_t group = 0;  // KeptPacket::group of all packets in this part

  [[nodiscard]] std::uint32_t packets() const { return std::uint32_t{end} - first; }
};

class FrameParts {
 public:
  // The maximum number of parts fused in one round. The maximum is close to the number of packets
  // that four LUX units send per frame. Parts are therefore small enough that no core has to wait
  // long for the last one.
  static constexpr std::size_t kMostOfARound = 24;

  // Splits the packets into parts. Each packet's group must be kNowhere or in the range 0 to
  // `groups - 1`. The size of a part is about the total number of bytes divided by `parts`. The
  // last part of a slice may be smaller. `parts` must be at most kMostOfARound.
  void deal(std::span<const KeptPacket> packets, std::size_t groups, std::size_t parts);

  // Returns the parts of the next round. A round contains as many slices as fit, each with all its
  // parts. If no parts are left, the result is empty.
  [[nodiscard]] std::span<const FramePart> next_round();

  // Returns the numbers of a part's packets within the frame.
  [[nodiscard]] std::span<const std::uint16_t> packets_of(const FramePart& part) const {
    return std::span(order_).subspan(part.first, std::size_t{part.end} - part.first);
  }

 private:
  // All parts of a group except the last are full-sized.
  static constexpr std::size_t kMaxGroups = kMaxSlices + 1;
  static constexpr std::size_t kMaxParts = kMostOfARound + kMaxGroups;

  void deal_group(std::span<const KeptPacket> packets, std::uint8_t group, std::size_t share);
  void end_part(std::size_t first, std::size_t end, std::uint8_t group);

  std::size_t ordered_ = 0;
  std::size_t count_ = 0;
  std::size_t dealt_ = 0;  // parts already assigned to rounds
  std::array<FramePart, kMaxParts> parts_{};
  std::array<std::uint16_t, kMaxFramePackets> order_{};
};

}  // namespace iog::fusion
