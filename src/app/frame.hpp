// The open frame: which packets belong to it, when it is over, and what became of them. It knows no
// clock and no network: time and datagrams are given to it, so that the target and `iog fuse` cut
// the same frames.
//
// A frame opens with its first packet. It is over when every sensor has delivered its scan, when a
// sensor's next scan begins, or when the vehicle's frame period is over, whichever is first. While
// nothing arrives at all, an empty frame is over every two periods, so that silence is reported.
//
// Whose fusion its points are added to, and when, is an engine's: app/grid_engine.hpp,
// app/perception_engine.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "grid/frame_fusion.hpp"
#include "intake/intake.hpp"
#include "intake/watched_sectors.hpp"
#include "stream/message.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::app {

// How many points had which fate.
using Fates = std::array<std::uint32_t, vehicle::kFateCount>;

class Frame {
 public:
  using Outcome = intake::Intake::Outcome;

  // vehicle outlives the frame. Its sensors' scans together mark at most grid::kMaxMarks cells.
  // replayer_ipv4 may send in the name of every sensor, 0: none.
  Frame(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4);

  // Before the first datagram: silence is counted from now on.
  void start(std::uint64_t now_us) { opened_us_ = now_us; }

  // The datagram as a sensor's packet. Empty if it was dropped. The payload outlives the packet.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram,
                                                            std::uint64_t /*now_us*/) {
    return intake_.receive(datagram);
  }

  // Whether it is for a sensor's port, from a sender that may speak for it.
  [[nodiscard]] bool listens_to(const intake::Datagram& datagram) const {
    return intake_.listens_to(datagram);
  }

  // Whether the packet belongs to the open frame; if to the next one, ask again after closing this.
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet) {
    return intake_.classify(packet);
  }

  // Counts the packet in. Only after classify() said kThisFrame.
  void accept(const intake::SensorPacket& packet, std::uint64_t now_us);
  // Adds its points to a fusion, now or later; or counts those that were added elsewhere.
  void add_points(grid::FrameFusion& fusion, std::size_t sensor, const intake::Packet& packet) {
    add_points(fusion, sensor, packet, fates_);
  }
  void add_points(grid::FrameFusion& fusion, std::size_t sensor, const intake::Packet& packet,
                  Fates& fates) const;
  void count(const Fates& fates);

  // The packet has waited too long; its points are counted as not taken.
  void leave(const intake::SensorPacket& packet) { intake_.leave(packet); }

  // Whether a packet has been counted in since the frame before.
  [[nodiscard]] bool is_begun() const { return intake_.packets_accepted() > 0; }

  // How many ticks of its turn a sensor has swept in it.
  [[nodiscard]] std::uint32_t swept_ticks(std::size_t sensor) const {
    return intake_.swept_ticks(sensor);
  }

  // Whether every sensor has delivered its scan.
  [[nodiscard]] bool is_complete() const { return intake_.is_complete(); }

  // Whether the frame's time is over.
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return now_us >= deadline_us(); }
  [[nodiscard]] std::uint64_t deadline_us() const;

  // Counted from 0; it wraps.
  [[nodiscard]] std::uint32_t number() const { return number_; }

  // What it knows of its header and end goes there.
  void describe(std::uint64_t now_us, stream::Header& header, stream::FrameEnd& end) const;

  // The frame is closed: the next one counts from 0 again.
  void start_next(std::uint64_t now_us);

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, vehicle_);
    intake_.for_each_constant(visit);
  }

 private:
  const vehicle::Vehicle* vehicle_;
  intake::Intake intake_;
  intake::WatchedSectors watched_;
  std::uint64_t opened_us_ = 0;
  std::uint32_t number_ = 0;
  Fates fates_{};
};

// Takes one datagram: calls close() where a frame is over before the datagram or with it, and
// fuse(packet) with a packet that belongs to the open frame. Engine: Frame, or what has its
// receive(), classify() and is_complete().
template <typename Engine, typename Fuse, typename Close>
void take_datagram(Engine& engine, const intake::Datagram& datagram, std::uint64_t now_us,
                   Fuse&& fuse, Close&& close) {
  using Outcome = Frame::Outcome;
  const std::optional<intake::SensorPacket> packet = engine.receive(datagram, now_us);
  Outcome outcome = packet ? engine.classify(*packet) : Outcome::kDropped;
  if (outcome == Outcome::kNextFrame) {
    close();
    outcome = engine.classify(*packet);
  }
  if (outcome == Outcome::kThisFrame) {
    fuse(*packet);
  }
  if (engine.is_complete()) {
    close();
  }
}

}  // namespace iog::app
