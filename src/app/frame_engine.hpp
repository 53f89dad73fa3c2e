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
#include <span>

#include "app/frame_report.hpp"
#include "grid/frame_fusion.hpp"
#include "intake/intake.hpp"
#include "vehicle/vehicle.hpp"
#include "work/crew.hpp"

namespace iog::app {

class FrameEngine {
 public:
  using Outcome = intake::Intake::Outcome;

  // vehicle outlives the engine. replayer_ipv4 may send in the name of every sensor, 0: nobody may.
  FrameEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4);

  // Before the first datagram: silence is counted from now on.
  void start(std::uint64_t now_us) { opened_us_ = now_us; }

  // The datagram as a sensor's packet. Empty if it was dropped. The payload outlives the packet.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram);

  // An engine is told when what has come; to this one it does not matter.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram,
                                                            std::uint64_t /*now_us*/) {
    return receive(datagram);
  }

  // Nor has it a use for a map.
  void begin_with_map(std::span<const std::uint8_t> /*block*/) {}

  // Whether the packet belongs to the open frame; if to the next one, ask again after closing this.
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet);

  // Only after classify() said kThisFrame: counts the packet in, and adds its points.
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us) {
    accept(packet, now_us);
    add_points(packet.sensor, packet.packet);
  }
  // An engine is given all cores; this one has a use for one.
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us, const work::Crew& /*crew*/) {
    fuse(packet, now_us);
  }
  // The two steps of it, for those who add points later; or the packet is dropped, because there is
  // no room for it.
  void accept(const intake::SensorPacket& packet, std::uint64_t now_us);
  void add_points(std::size_t sensor, const intake::Packet& packet);

  // How many points had which fate.
  using Fates = std::array<std::uint32_t, vehicle::kFateCount>;
  // Adds points to another fusion of the vehicle, and counts them there; what is counted so is told
  // to the engine.
  static void add_points_to(grid::FrameFusion& fusion, const vehicle::Sensor& sensor,
                            const intake::Packet& packet, Fates& fates);
  void count(const Fates& fates);

  void refuse(const intake::SensorPacket& packet) { intake_.refuse(packet); }

  // The packet has waited too long; its points are counted as not taken.
  void leave(const intake::SensorPacket& packet) { intake_.leave(packet); }

  // Whether a packet has been counted in since the frame before.
  [[nodiscard]] bool is_begun() const { return intake_.packets_accepted() > 0; }

  // Whether every sensor has delivered its scan.
  [[nodiscard]] bool is_complete() const { return intake_.is_complete(); }

  // Whether the frame's time is over. See deadline_us().
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return now_us >= deadline_us(); }
  [[nodiscard]] std::uint64_t deadline_us() const;

  // Of the frame, counted from 0; it wraps.
  [[nodiscard]] std::uint32_t number() const { return frame_number_; }

  // A frame is closed step by step. finish() completes the grid, and calls lap(stage) with the
  // stream::StageTicks that has just ended.
  void finish() { fusion_.finish(); }
  template <typename Lap>
  void finish(std::uint64_t /*now_us*/, const work::Crew& /*crew*/, Lap&& lap) {
    fusion_.finish();
    lap(&stream::StageTicks::mark);
  }
  // What the frame says of itself.
  [[nodiscard]] FrameReport report(std::uint64_t now_us) const;
  // The finished grid, for whoever wants to look at it.
  [[nodiscard]] grid::FrameView view() const { return fusion_.view(); }
  // Calls visit(number, cells) for each tile in which something is known, in rising order, and
  // clears the grid.
  template <typename Visit>
  void release(Visit&& visit) {
    fusion_.release(
        [&visit](std::size_t tile, auto indexes) { visit(tile, std::as_bytes(indexes)); });
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
  std::uint32_t frame_number_ = 0;
  Fates fates_{};
};

}  // namespace iog::app
