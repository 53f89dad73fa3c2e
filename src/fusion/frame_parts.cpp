#include "fusion/frame_parts.hpp"

#include <algorithm>

#include "require/require.hpp"

namespace iog::fusion {

namespace {

std::size_t bytes_of(std::span<const KeptPacket> packets) {
  std::size_t bytes = 0;
  for (const KeptPacket& packet : packets) {
    bytes += packet.bytes;
  }
  return bytes;
}

}  // namespace

// The share is rounded up. Together the groups have at most `parts` full parts, and each group at
// most one that is not full. A group with all the full parts has nothing left over.
void FrameParts::deal(std::span<const KeptPacket> packets, std::size_t groups, std::size_t parts) {
  require(parts > 0 && parts <= kMostOfARound && groups < kMaxGroups);
  ordered_ = 0;
  count_ = 0;
  dealt_ = 0;
  const std::size_t share = (bytes_of(packets) + parts - 1) / parts;
  for (std::size_t group = 0; group < groups; ++group) {
    deal_group(packets, static_cast<std::uint8_t>(group), share);
  }
  deal_group(packets, FrameSlices::kNowhere, share);
}

void FrameParts::deal_group(std::span<const KeptPacket> packets, std::uint8_t group,
                            std::size_t share) {
  std::size_t first = ordered_;
  std::size_t bytes = 0;
  for (std::size_t number = 0; number < packets.size(); ++number) {
    if (packets[number].group != group) {
      continue;
    }
    order_[ordered_++] = static_cast<std::uint16_t>(number);
    bytes += packets[number].bytes;
    if (bytes >= share) {
      end_part(first, ordered_, group);
      first = ordered_;
      bytes = 0;
    }
  }
  if (first != ordered_) {
    end_part(first, ordered_, group);
  }
}

void FrameParts::end_part(std::size_t first, std::size_t end, std::uint8_t group) {
  require(count_ < kMaxParts);
  parts_[count_++] = {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(end), group};
}

std::span<const FramePart> FrameParts::next_round() {
  const std::size_t first = dealt_;
  std::size_t end = std::min(count_, first + kMostOfARound);
  while (end < count_ && end > first && parts_[end].group == parts_[end - 1].group) {
    --end;
  }
  dealt_ = end;
  return std::span(parts_).subspan(first, end - first);
}

}  // namespace iog::fusion
