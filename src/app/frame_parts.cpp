#include "app/frame_parts.hpp"

#include <algorithm>

#include "require/require.hpp"

namespace iog::app {

namespace {

std::size_t bytes_of(std::span<const KeptPacket> packets) {
  std::size_t bytes = 0;
  for (const KeptPacket& packet : packets) {
    bytes += packet.bytes;
  }
  return bytes;
}

}  // namespace

void FrameParts::begin() {
  ordered_ = 0;
  count_ = 0;
  dealt_ = 0;
}

// With b_g bytes a group g has at most b_g / share parts that are full and one that is not. So a
// group has at most kMostOfARound, as share is more than a (kMostOfARound - 1)-th of all bytes, and
// all groups have at most kMostOfARound - 1 and one each.
void FrameParts::deal(std::span<const KeptPacket> packets, std::size_t placed_groups) {
  begin();
  const std::size_t share = bytes_of(packets) / (kMostOfARound - 1) + 1;
  for (std::size_t group = 0; group < placed_groups; ++group) {
    deal_group(packets, static_cast<std::uint8_t>(group), share);
  }
  deal_group(packets, FrameSlices::kNowhere, share);
}

// A share is rounded up, so that what is left after the full parts is no part of its own.
void FrameParts::deal_evenly(std::span<const KeptPacket> packets, std::size_t parts) {
  require(parts > 0 && parts <= kMostOfARound);
  begin();
  deal_group(packets, 0, (bytes_of(packets) + parts - 1) / parts);
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

}  // namespace iog::app
