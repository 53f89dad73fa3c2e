#include "fusion/frame_packets.hpp"

#include <algorithm>

#include "require/require.hpp"

namespace iog::fusion {
namespace {

// Longer than any datagram.
constexpr std::size_t kLongestPacket = 0xFFFF;
static_assert(kLongestPacket <= kMaxFrameBytes);

}  // namespace

bool FramePackets::fits(const intake::SensorPacket& packet) const {
  return count_ < kMaxFramePackets && packet.payload.size() <= kMaxFrameBytes - bytes_used_;
}

void FramePackets::keep(const intake::SensorPacket& packet, std::uint64_t time_us) {
  require(fits(packet) && packet.payload.size() <= kLongestPacket);
  packets_[count_] = {.time_us = time_us,
                      .bytes = static_cast<std::uint16_t>(packet.payload.size()),
                      .sensor = static_cast<std::uint8_t>(packet.sensor)};
  const auto copy = std::span(bytes_).subspan(bytes_used_, packet.payload.size());
  std::ranges::copy(packet.payload, copy.begin());
  decoded_[count_] = packet.packet;
  decoded_[count_].move_to(copy);
  ++count_;
  bytes_used_ += packet.payload.size();
  points_ += packet.packet.info().point_count;
}

void FramePackets::clear() {
  count_ = 0;
  bytes_used_ = 0;
  points_ = 0;
}

}  // namespace iog::fusion
