// The slices of a frame: its packets by when they were measured, and where the vehicle was then.
//
// A slice is found by time alone and placed by one pose, so neither the order nor the grouping of
// packets shows. Poses are asked for when the frame ends; by then most slices lie between two of
// them.
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

// Slices of one frame that are placed. 32 of 8 ms are more than twice the turn of a VLP-16.
inline constexpr std::size_t kMaxSlices = stream::kMaxSlices;

struct PlacedSlice {
  pose::Slice slice{};
  pose::Pose pose{};  // of its middle
  pose::Sigma sigma{};
  friend bool operator==(const PlacedSlice&, const PlacedSlice&) = default;
};

class FrameSlices {
 public:
  // The group of packets that have no place; those of the slice placed()[i] are group i.
  static constexpr std::uint8_t kNowhere = 0xFF;

  // Puts the packets' times on the clock of the poses and returns the end of the last slice. Empty
  // if no packet has a time: the sensor is not synchronised, and no pose says how the clocks
  // differ.
  std::optional<std::uint64_t> measure(std::span<const vehicle::Sensor> sensors,
                                       std::span<KeptPacket> packets, const pose::Source& poses);

  // Asks for the pose of each slice, once, and puts each packet into its group. After measure(),
  // with the same packets.
  void place(std::span<KeptPacket> packets, pose::Source& poses);

  // In the order of their times.
  [[nodiscard]] std::span<const PlacedSlice> placed() const {
    return std::span(placed_).first(count_);
  }
  // What became of slices and packets goes there; those that have a pose, and no room here, are
  // over budget.
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
