// The engine of cars without classes: datagrams in, frames out, as FrameEngine, whose frames these
// are.
//
// One core fuses each packet as it comes. A dense lidar sends more than one core may have time for:
// with several, its packets are kept until there is a part for each of them, fused in a round while
// the next ones come, and joined when the frame ends (app/parts_fusion.hpp): the same bytes.
//
//     packets -> [FramePackets] a part for each core -> [PartsFusion] its tiles  while they come
//                                                tiles -> [JoinedGrid] grid       at the end
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "app/frame_engine.hpp"
#include "app/frame_packets.hpp"
#include "app/frame_parts.hpp"
#include "app/frame_report.hpp"
#include "app/parts_fusion.hpp"
#include "grid/frame_fusion.hpp"
#include "grid/joined_grid.hpp"
#include "vehicle/vehicle.hpp"
#include "work/crew.hpp"

namespace iog::app {

// Whether several cores fuse the frames of this car: one of its lidars is dense, and parts of a
// frame join by its fusion rule. What four LUX send in a frame is fused by one core before two have
// divided it.
[[nodiscard]] bool is_fused_together(const vehicle::Vehicle& vehicle);

// Holds 80 MB: belongs into static memory.
class GridEngine {
 public:
  using Outcome = FrameEngine::Outcome;

  // As FrameEngine.
  GridEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4)
      : frame_(vehicle, replayer_ipv4),
        fused_(vehicle),
        packets_(vehicle.sensors),
        vehicle_(&vehicle),
        may_share_(is_fused_together(vehicle)) {}

  void start(std::uint64_t now_us) { frame_.start(now_us); }
  void begin_with_map(std::span<const std::uint8_t> block) { frame_.begin_with_map(block); }

  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram,
                                                            std::uint64_t now_us) {
    return frame_.receive(datagram, now_us);
  }
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet) {
    return frame_.classify(packet);
  }

  // Only after classify() said kThisFrame: counts the packet in, and has its points added by the
  // crew, now or later; or drops it, as FrameEngine::classify() does, because its points find no
  // room in the frame.
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us, const work::Crew& crew);

  void leave(const intake::SensorPacket& packet) { frame_.leave(packet); }
  [[nodiscard]] bool is_complete() const { return frame_.is_complete(); }
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return frame_.is_overdue(now_us); }
  [[nodiscard]] std::uint64_t deadline_us() const { return frame_.deadline_us(); }

  // A frame is closed step by step, as FrameEngine does it.
  template <typename Lap>
  void finish(std::uint64_t now_us, const work::Crew& crew, Lap&& lap) {
    if (is_shared_) {
      fuse_kept(crew);
      lap(&stream::StageTicks::fuse);
      join(crew);
      lap(&stream::StageTicks::mark);
    } else {
      frame_.finish(now_us, crew, lap);
    }
  }
  [[nodiscard]] FrameReport report(std::uint64_t now_us) const { return frame_.report(now_us); }
  template <typename Visit>
  void release(Visit&& visit) {
    if (is_shared_) {
      joined_.release(visit);
    } else {
      frame_.release(visit);
    }
  }
  void start_next(std::uint64_t now_us);

  [[nodiscard]] grid::FrameFusion& fusion() { return frame_.fusion(); }

 private:
  [[nodiscard]] bool has_room(const intake::SensorPacket& packet, const work::Crew& crew);
  void fuse_kept(const work::Crew& crew);
  void join(const work::Crew& crew);

  // What is aligned to a cache line comes first.
  FrameEngine frame_;
  PartsFusion fused_;
  grid::JoinedGrid joined_;
  FramePackets packets_;
  FrameParts parts_;
  const vehicle::Vehicle* vehicle_;
  bool may_share_;
  // Of the frame.
  bool is_shared_ = false;
  bool is_joined_ = false;  // something of it is in the joined grid
  std::size_t places_ = 0;  // of its parts that are fused and not yet joined
  std::size_t marks_ = 0;   // of its points that are fused
};

}  // namespace iog::app
