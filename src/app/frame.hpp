// The open frame: which packets belong to it, when it is over, and what became of them. It knows no
// clock and no network: time and datagrams are given to it, so that the target and `iog fuse` cut
// the same frames.
//
// A frame opens with its first packet. It is over when every sensor has delivered its scan, when a
// sensor's next scan begins, or when the vehicle's frame period is over, whichever is first. While
// nothing arrives at all, an empty frame is over every two periods, so that silence is reported.
//
// One core fuses each packet as it comes. A dense lidar sends more than one core may have time for:
// with several, its packets are kept until there is a part for each of them, fused in a round while
// the next ones come, and joined when the frame ends (fusion/shared_fusion.hpp): the same bytes. Of
// a frame with classes all packets are kept until it ends (app/perception_engine.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "fusion/shared_fusion.hpp"
#include "health/constants.hpp"
#include "intake/intake.hpp"
#include "intake/watched_sectors.hpp"
#include "stream/message.hpp"
#include "vehicle/vehicle.hpp"
#include "work/crew.hpp"

namespace iog::app {

// Whether several cores fuse the frames of this car while they come: one of its lidars is dense,
// and parts of a frame join by its fusion rule. What four LUX send in a frame is fused by one core
// before two have divided it.
[[nodiscard]] bool is_fused_together(const vehicle::Vehicle& vehicle);

// When the points of a frame's packets are fused.
enum class Fusing : std::uint8_t { kAsTheyCome, kAtItsEnd };

// Holds 19 MB: belongs into static memory.
class Frame {
 public:
  using Outcome = intake::Intake::Outcome;

  // vehicle and space outlive the frame. Its sensors' scans together mark at most grid::kMaxMarks
  // cells. replayer_ipv4 may send in the name of every sensor, 0: none.
  Frame(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4,
        fusion::HelpersSpace space = {}, Fusing fusing = Fusing::kAsTheyCome);

  // Before the first datagram: silence is counted from now on.
  void start(std::uint64_t now_us) { opened_us_ = now_us; }

  // The datagram as a sensor's packet. Empty if it was dropped. The payload outlives the packet.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram) {
    return intake_.receive(datagram);
  }

  // Whether it is for a sensor's port, from a sender that may speak for it.
  [[nodiscard]] bool listens_to(const intake::Datagram& datagram) const {
    return intake_.listens_to(datagram);
  }

  // Whether the packet belongs to the open frame; if to the next one, ask again after closing this.
  // One that cannot be kept with the others belongs to the next.
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet) {
    const Outcome outcome = intake_.classify(packet);
    const bool is_full = fusing_ == Fusing::kAtItsEnd && !fusion_.packets().fits(packet);
    return outcome == Outcome::kThisFrame && is_full ? Outcome::kNextFrame : outcome;
  }

  // Only after classify() said kThisFrame. Counts the packet in; and keeps it, by when it was
  // measured; or has its points fused by the crew, now or later.
  void accept(const intake::SensorPacket& packet, std::uint64_t now_us);
  void keep(const intake::SensorPacket& packet, std::uint64_t now_us, std::uint64_t measured_us) {
    accept(packet, now_us);
    fusion_.packets().keep(packet, measured_us);
  }
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us, const work::Crew& crew);

  // With those that were kept.
  [[nodiscard]] fusion::SharedFusion& fusion() { return fusion_; }

  // The packet has waited too long; its points are counted as not taken.
  void leave(const intake::SensorPacket& packet) { intake_.leave(packet); }

  // Whether a packet has been counted in since the frame before.
  [[nodiscard]] bool is_begun() const { return intake_.packets_accepted() > 0; }

  // Whether every sensor has delivered its scan.
  [[nodiscard]] bool is_complete() const { return intake_.is_complete(); }

  // Whether the frame's time is over.
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return now_us >= deadline_us(); }
  [[nodiscard]] std::uint64_t deadline_us() const;

  // Counted from 0; it wraps.
  [[nodiscard]] std::uint32_t number() const { return number_; }

  // A frame is closed step by step. finish() completes the grid, and calls lap(stage) with the
  // stream::StageTicks that has just ended. end_fusion() is its last step, where somebody else has
  // fused what was kept.
  template <typename Lap>
  void finish(const work::Crew& crew, Lap&& lap) {
    if (is_shared_) {
      fuse_kept(crew);
      lap(&stream::StageTicks::fuse);
      fusion_.join(crew);
    } else {
      fusion_.own().finish();
    }
    end_fusion();
    lap(&stream::StageTicks::mark);
  }
  void end_fusion() { fusion_.end_frame(intake_); }

  // What it knows of its header and end goes there.
  void describe(std::uint64_t now_us, stream::Header& header, stream::FrameEnd& end) const;

  // As SharedFusion::release().
  template <typename Visit>
  void release(Visit&& visit) {
    fusion_.release(visit);
  }

  // The frame is closed and its grid is clear: the next one counts from 0 again.
  void start_next(std::uint64_t now_us);

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    fusion_.for_each_guard(visit);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    fusion_.for_each_constant(visit);
    health::visit_constants(visit, vehicle_, fusing_, may_share_);
    intake_.for_each_constant(visit);
  }

 private:
  void fuse_kept(const work::Crew& crew) { fusion_.fuse_kept(crew, crew.cores()); }

  // What is aligned to a cache line comes first.
  fusion::SharedFusion fusion_;
  const vehicle::Vehicle* vehicle_;
  Fusing fusing_;
  bool may_share_;
  bool is_shared_ = false;  // several cores fuse the open frame
  intake::Intake intake_;
  intake::WatchedSectors watched_;
  std::uint64_t opened_us_ = 0;
  std::uint32_t number_ = 0;
};

// Takes one datagram, if it was a sensor's packet: calls close() where a frame is over before it or
// with it, and fuse(packet) with a packet that belongs to the open frame.
template <typename Fuse, typename Close>
void take_packet(Frame& frame, const std::optional<intake::SensorPacket>& packet, Fuse&& fuse,
                 Close&& close) {
  using Outcome = Frame::Outcome;
  Outcome outcome = packet ? frame.classify(*packet) : Outcome::kDropped;
  if (outcome == Outcome::kNextFrame) {
    close();
    outcome = frame.classify(*packet);
  }
  if (outcome == Outcome::kThisFrame) {
    fuse(*packet);
  }
  if (frame.is_complete()) {
    close();
  }
}

}  // namespace iog::app
