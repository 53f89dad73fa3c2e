#include "fusion/frame_slices.hpp"

#include <algorithm>

namespace iog::fusion {

std::optional<std::uint64_t> FrameSlices::measure(std::span<const vehicle::Sensor> sensors,
                                                  std::span<KeptPacket> packets,
                                                  const pose::Source& poses) {
  std::optional<std::uint64_t> last_end_us;
  for (KeptPacket& packet : packets) {
    const std::optional<std::uint64_t> time_us = sensors[packet.sensor].is_synchronised
                                                     ? std::optional(packet.time_us)
                                                     : poses.source_time(packet.time_us);
    packet.has_time = time_us.has_value();
    if (!time_us) {
      continue;
    }
    const pose::Slice slice = poses.slice_of(*time_us);
    packet.time_us = *time_us;
    packet.slice = slice.number;
    last_end_us = std::max(last_end_us.value_or(0), slice.end_us);
  }
  return last_end_us;
}

// Handles the slices in order of time. Each pass over the packets assigns one slice its group and
// finds the next slice. A frame has at most as many slices as packets.
void FrameSlices::place(std::span<KeptPacket> packets, pose::Source& poses) {
  count_ = 0;
  over_budget_ = 0;
  const KeptPacket* next = nullptr;
  const auto offer = [&](const KeptPacket& packet) {
    next = next != nullptr && next->slice <= packet.slice ? next : &packet;
  };
  for (KeptPacket& packet : packets) {
    packet.group = kNowhere;
    if (packet.has_time) {
      offer(packet);
    }
  }
  while (next != nullptr) {
    const std::uint64_t number = next->slice;
    const std::uint8_t group = group_of(poses.slice_of(next->time_us), poses);
    next = nullptr;
    for (KeptPacket& packet : packets) {
      if (packet.has_time && packet.slice == number) {
        packet.group = group;
      } else if (packet.has_time && packet.slice > number) {
        offer(packet);
      }
    }
  }
  packets_not_placed_ =
      static_cast<std::uint32_t>(std::ranges::count(packets, kNowhere, &KeptPacket::group));
  packets_placed_ = static_cast<std::uint32_t>(packets.size()) - packets_not_placed_;
}

void FrameSlices::describe(stream::ClassEnd& end) const {
  end.packets_placed = packets_placed_;
  end.packets_not_placed = packets_not_placed_;
  end.slices_over_budget = over_budget_;
  end.slice_count = static_cast<std::uint8_t>(count_);
  std::ranges::transform(placed(), end.slices.begin(), [](const PlacedSlice& slice) {
    return stream::SliceRecord{
        .middle_us = slice.slice.middle_us, .pose = slice.pose, .sigma = slice.sigma};
  });
}

std::uint8_t FrameSlices::group_of(const pose::Slice& slice, pose::Source& poses) {
  const pose::Placed placed = poses.place(slice);
  if (!placed.has_pose()) {
    return kNowhere;
  }
  if (count_ == placed_.size()) {
    ++over_budget_;
    return kNowhere;
  }
  placed_[count_] = {.slice = slice, .pose = placed.pose, .sigma = placed.sigma};
  return static_cast<std::uint8_t>(count_++);
}

}  // namespace iog::fusion
