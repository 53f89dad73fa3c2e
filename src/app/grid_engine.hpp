// The engine of cars without classes: datagrams in, frames out.
//
// One core fuses each packet as it comes. A dense lidar sends more than one core may have time for:
// with several, its packets are kept until there is a part for each of them, fused in a round while
// the next ones come, and joined when the frame ends (app/shared_fusion.hpp): the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/frame.hpp"
#include "app/frame_packets.hpp"
#include "app/shared_fusion.hpp"
#include "health/guard.hpp"
#include "vehicle/vehicle.hpp"
#include "work/crew.hpp"

namespace iog::app {

// Whether several cores fuse the frames of this car: one of its lidars is dense, and parts of a
// frame join by its fusion rule. What four LUX send in a frame is fused by one core before two have
// divided it.
[[nodiscard]] bool is_fused_together(const vehicle::Vehicle& vehicle);

// Holds 17 MB: belongs into static memory.
class GridEngine {
 public:
  using Outcome = Frame::Outcome;

  // As Frame and SharedFusion.
  GridEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, HelpersSpace space)
      : fusion_(vehicle, space),
        frame_(vehicle, replayer_ipv4),
        may_share_(is_fused_together(vehicle)) {}

  // As of Frame.
  void start(std::uint64_t now_us) { frame_.start(now_us); }
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram,
                                                            std::uint64_t now_us) {
    return frame_.receive(datagram, now_us);
  }
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet) {
    return frame_.classify(packet);
  }
  void leave(const intake::SensorPacket& packet) { frame_.leave(packet); }
  [[nodiscard]] bool is_begun() const { return frame_.is_begun(); }
  [[nodiscard]] bool is_complete() const { return frame_.is_complete(); }
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return frame_.is_overdue(now_us); }
  [[nodiscard]] std::uint64_t deadline_us() const { return frame_.deadline_us(); }

  // Only after classify() said kThisFrame: counts the packet in, and has its points fused by the
  // crew, now or later.
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us, const work::Crew& crew);

  // A frame is closed step by step. finish() completes the grid, and calls lap(stage) with the
  // stream::StageTicks that has just ended.
  template <typename Lap>
  void finish(std::uint64_t /*now_us*/, const work::Crew& crew, Lap&& lap) {
    if (is_shared_) {
      fuse_kept(crew);
      lap(&stream::StageTicks::fuse);
      fusion_.join(crew);
    } else {
      fusion_.own().finish();
    }
    fusion_.end_frame(frame_);
    lap(&stream::StageTicks::mark);
  }
  // What it knows of its header and end goes there.
  void describe(std::uint64_t now_us, stream::Header& header, stream::FrameEnd& end) const {
    frame_.describe(now_us, header, end);
  }
  // Calls visit(number, cells) for each tile in which something is known, in rising order, and
  // clears the grid.
  template <typename Visit>
  void release(Visit&& visit) {
    if (is_shared_) {
      fusion_.release(visit);
    } else {
      fusion_.own().release(
          [&visit](std::size_t tile, auto indexes) { visit(tile, std::as_bytes(indexes)); });
    }
  }
  // The grid is clear; counts from 0 again.
  void start_next(std::uint64_t now_us) {
    is_shared_ = false;
    frame_.start_next(now_us);
  }

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    fusion_.for_each_guard(visit);
    visit(behind_packets_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    fusion_.for_each_constant(visit);
    frame_.for_each_constant(visit);
    health::visit_constants(visit, may_share_);
  }

 private:
  void fuse_kept(const work::Crew& crew);

  // What is aligned to a cache line comes first.
  SharedFusion fusion_;
  Frame frame_;
  FramePackets packets_;
  health::Guard behind_packets_;
  bool may_share_;
  bool is_shared_ = false;  // the frame is
};

}  // namespace iog::app
