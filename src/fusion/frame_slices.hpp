// The slices of a frame: groups its packets by time of measurement, and finds where the vehicle was
// then.
//
// Only time decides the slice of a packet, and each slice has one pose. So the result does not
// depend on the order or grouping of packets. Poses are looked up when the frame ends; by then most
// slices lie between two of them.
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

// The most registered slices of one frame. 32 slices of 8 ms are more than twice the turn of a
// VLP-16.
inline constexpr std::size_t kMaxSlices = stream::kMaxSlices;

struct PlacedSlice {
  pose::Slice slice{};
  pose::Pose pose{};  // at its middle
  pose::Sigma sigma{};
  friend bool operator==(const PlacedSlice&, const PlacedSlice&) = default;
};

class FrameSlices {
 public:
  // The group of packets that are not registered. Packets of the slice placed()[i] have group i.
  static constexpr std::uint8_t kNowhere = 0xFF;

  // Converts the packets' times to the clock of the poses and returns the end of the last slice.
  // Returns nothing if no packet has a time: the sensor is not synchronised, and no pose gives the
  // offset between the clocks.
  std::optional<std::uint64_t> measure(std::span<const vehicle::Sensor> sensors,
                                       std::span<KeptPacket> packets, const pose::Source& poses);

  // Looks up the pose of each slice once, and assigns each packet its group. Call it after
  // measure(), with the same packets.
  void place(std::span<KeptPacket> packets, pose::Source& poses);

  // In order of time.
  [[nodiscard]] std::span<const PlacedSlice> placed() const {
    return std::span(placed_).first(count_);
  }
  // Writes the registered slices, and the counts of slices and packets, into the message. A slice
  // with a pose is over budget if there is no room for it here.
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
