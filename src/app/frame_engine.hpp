// The engine: datagrams in, frames out. It decides when a frame is over, and hands the points of
// its packets to the fusion. It knows no clock and no network: time and datagrams are given to it,
// so that the target and `iog fuse` run the same frames.
//
// A frame opens with its first packet. It is over when every sensor has delivered its scan, when a
// sensor's next scan begins, or when the vehicle's frame period is over, whichever is first. While
// nothing arrives at all, an empty frame is over every two periods, so that silence is reported.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "app/frame_report.hpp"
#include "grid/frame_fusion.hpp"
#include "intake/intake.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

class FrameEngine {
 public:
  using Outcome = intake::Intake::Outcome;

  // vehicle outlives the engine. replayer_ipv4 may send in the name of every sensor, 0: nobody may.
  // start_us: the time from which silence is counted.
  FrameEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, std::uint64_t start_us);

  // The datagram as a sensor's packet. Empty if it was dropped. The payload outlives the packet.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram);

  // Whether the packet belongs to the open frame; if to the next one, ask again after closing this.
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet);

  // Only after classify() said kThisFrame.
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us);

  // Whether every sensor has delivered its scan.
  [[nodiscard]] bool is_complete() const { return intake_.is_complete(); }

  // Whether the frame's time is over. See deadline_us().
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return now_us >= deadline_us(); }
  [[nodiscard]] std::uint64_t deadline_us() const;

  // A frame is closed step by step. finish() completes the grid.
  void finish() { fusion_.finish(); }
  // What the frame says of itself.
  [[nodiscard]] FrameReport report(std::uint64_t now_us) const;
  // The finished grid, for whoever wants to look at it.
  [[nodiscard]] grid::FrameView view() const { return fusion_.view(); }
  // Calls visit(number, cells) for each tile in which something is known, in rising order, and
  // clears the grid.
  template <typename Visit>
  void release(Visit&& visit) {
    fusion_.release(visit);
  }
  // The grid is clear; counts from 0 again.
  void start_next(std::uint64_t now_us);

  [[nodiscard]] grid::FrameFusion& fusion() { return fusion_; }

 private:
  // What is aligned to a cache line comes first.
  grid::FrameFusion fusion_;
  const vehicle::Vehicle* vehicle_;
  intake::Intake intake_;

  std::uint64_t opened_us_ = 0;
  std::uint32_t vehicle_id_;
  std::uint32_t frame_number_ = 0;
  std::array<std::uint32_t, vehicle::kFateCount> fates_{};
};

}  // namespace iog::app
