#include "app/frame_packets.hpp"

#include <algorithm>

#include "grid/pending_marks.hpp"
#include "require/require.hpp"

namespace iog::app {

std::uint64_t FramePackets::marks_of(const intake::SensorPacket& packet) const {
  return std::uint64_t{packet.packet.info().point_count} *
         grid::max_marks_per_point(sensors_[packet.sensor]);
}

// A datagram is shorter than 2^16 bytes.
bool FramePackets::fits(const intake::SensorPacket& packet) const {
  return count_ < kMaxFramePackets && packet.payload.size() <= kMaxFrameBytes - bytes_used_ &&
         packet.payload.size() <= 0xFFFF && marks_of(packet) <= kMaxFrameMarks - marks_;
}

void FramePackets::keep(const intake::SensorPacket& packet, std::uint64_t time_us) {
  require(fits(packet));
  packets_[count_] = {.time_us = time_us,
                      .bytes = static_cast<std::uint16_t>(packet.payload.size()),
                      .sensor = static_cast<std::uint8_t>(packet.sensor)};
  const auto copy = std::span(bytes_).subspan(bytes_used_, packet.payload.size());
  std::ranges::copy(packet.payload, copy.begin());
  decoded_[count_] = packet.packet;
  decoded_[count_].move_to(copy);
  ++count_;
  bytes_used_ += packet.payload.size();
  marks_ += marks_of(packet);
}

void FramePackets::clear() {
  count_ = 0;
  bytes_used_ = 0;
  marks_ = 0;
}

}  // namespace iog::app
