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
                      .first_byte = static_cast<std::uint32_t>(bytes_used_),
                      .bytes = static_cast<std::uint16_t>(packet.payload.size()),
                      .sensor = static_cast<std::uint8_t>(packet.sensor)};
  std::ranges::copy(packet.payload, &bytes_[bytes_used_]);
  ++count_;
  bytes_used_ += packet.payload.size();
  marks_ += marks_of(packet);
}

void FramePackets::clear() {
  count_ = 0;
  bytes_used_ = 0;
  marks_ = 0;
}

intake::Packet FramePackets::decoded(const KeptPacket& packet) const {
  const vehicle::Sensor& sensor = sensors_[packet.sensor];
  return intake::Packet::decode(
      sensor.format, std::span(bytes_).subspan(packet.first_byte, packet.bytes), sensor.unit());
}

}  // namespace iog::app
