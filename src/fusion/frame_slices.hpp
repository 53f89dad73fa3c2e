// The slices of a frame. This class groups the frame's packets by measurement time, and looks up
// the vehicle's pose for each slice.
//
// The slice of a packet depends only on the packet's measurement time, and each slice has one pose.
// The order and grouping of packets therefore do not affect the result. Poses are looked up at the
// end of the frame because most slices lie between two poses by then.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "fusion/frame_packets.hpp"
#include "pose/pose.hpp"
#include "pose/slice.hpp"
#include "pose/source.hpp"
#include "stream/class_end.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::fusion {

// The maximum number of registered slices per frame. Together, 32 slices of 8 ms cover more than
// two revolutions of a VLP-16.
inline constexpr std::size_t kMaxSlices = stream::kMaxSlices;

struct PlacedSlice {
  pose::Slice slice{};
  pose::Pose pose{};  // at the middle of the slice
  pose::Sigma sigma{};
  friend bool operator==(const PlacedSlice&, const PlacedSlice&) = default;
};

class FrameSlices {
 public:
  // The group number of packets that are not registered. Packets of slice placed()[i] belong to
  // group i.
  static constexpr std::uint8_t kNowhere = 0xFF;

  // Converts the packets' times to the pose source's clock and returns the end of the last slice.
  // Returns std::nullopt if no packet has a time on the pose source's clock. This is the case if no
  // sensor is synchronised and no pose provides the offset between the clocks.
  std::optional<std::uint64_t> measure(std::span<const vehicle::Sensor> sensors,
                                       std::span<KeptPacket> packets, const pose::Source& poses);

  // Looks up the pose of each slice once, and assigns a group to each packet. Call this function
  // after measure(), with the same packets.
  void place(std::span<KeptPacket> packets, pose::Source& poses);

  // Returns the registered slices in chronological order.
  [[nodiscard]] std::span<const PlacedSlice> placed() const {
    return std::span(placed_).first(count_);
  }
  // Writes the registered slices and the counts of slices and packets into the message. A slice is
  // counted as over budget if it has a pose but does not fit into this buffer.
  void describe(stream::ClassEnd& end) const;

 private:
  [[nodiscard]] std::uint8_t group_of(const pose::Slice& slice, pose::Source& poses);

  std::size_t count_ = 0;
  std::uint32_t over_budget_ = 0;
  std::uint32_t packets_placed_ = 0;
  std::uint32_t packets_not_placed_ = 0;
  std::array<PlacedSlice, kMaxSlices> placed_{};
};

}  // namespace iog::fusion
