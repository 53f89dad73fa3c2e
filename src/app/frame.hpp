// The open frame: decides which packets belong to it and when it ends, and records their outcomes.
// Time and datagrams are arguments, so the target and `iog fuse` cut the same frames without a
// clock or a network.
//
// A frame opens with its first packet. It ends when every sensor has delivered its scan, when a
// sensor's next scan begins, or when the vehicle's frame period has passed, whichever comes first.
// If nothing arrives, an empty frame ends every two periods, so that silence is reported.
//
// One core fuses each packet on arrival. A dense lidar may send more than one core can process.
// With several cores, its packets are buffered until there is a part for each core. The parts are
// fused in a round while the next packets arrive, and joined when the frame ends
// (fusion/shared_fusion.hpp). The bytes are the same. If the frame has classes, all packets are
// buffered until it ends (app/perception_engine.hpp).
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

// Whether several cores fuse this car's packets on arrival. This needs a dense lidar, and a fusion
// rule that can join parts of a frame. For four LUX one core is enough: it has fused their frame
// before two cores have divided it.
[[nodiscard]] bool is_fused_together(const vehicle::Vehicle& vehicle);

// When the points of a frame's packets are fused.
enum class Fusing : std::uint8_t { kAsTheyCome, kAtItsEnd };

// Holds 19 MB, so it must be in static memory.
class Frame {
 public:
  using Outcome = intake::Intake::Outcome;

  // vehicle and space must outlive the frame. The scans of all sensors together may mark at most
  // grid::kMaxMarks cells. replayer_ipv4 may send in the name of every sensor; 0: none.
  Frame(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4,
        fusion::HelpersSpace space = {}, Fusing fusing = Fusing::kAsTheyCome);

  // Call it before the first datagram. Silence is counted from now on.
  void start(std::uint64_t now_us) { opened_us_ = now_us; }

  // Reads the datagram as a sensor's packet. Returns nothing if it was dropped. The payload must
  // outlive the packet.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram) {
    return intake_.receive(datagram);
  }

  // Whether the datagram is for a sensor's port, from a sender that may speak for the sensor.
  [[nodiscard]] bool listens_to(const intake::Datagram& datagram) const {
    return intake_.listens_to(datagram);
  }

  // Whether the packet belongs to the open frame. If it belongs to the next one, close this frame
  // and ask again. A packet without room in this frame's buffer belongs to the next.
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet) {
    const Outcome outcome = intake_.classify(packet);
    const bool is_full = fusing_ == Fusing::kAtItsEnd && !fusion_.packets().fits(packet);
    return outcome == Outcome::kThisFrame && is_full ? Outcome::kNextFrame : outcome;
  }

  // Only after classify() returned kThisFrame. accept() counts the packet. keep() also buffers it,
  // with its time of measurement. fuse() also has the crew fuse its points, now or later.
  void accept(const intake::SensorPacket& packet, std::uint64_t now_us);
  void keep(const intake::SensorPacket& packet, std::uint64_t now_us, std::uint64_t measured_us) {
    accept(packet, now_us);
    fusion_.packets().keep(packet, measured_us);
  }
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us, const work::Crew& crew);

  // The fusion, with the buffered packets.
  [[nodiscard]] fusion::SharedFusion& fusion() { return fusion_; }

  // Sheds a packet that has waited too long. Its points are counted as not taken.
  void leave(const intake::SensorPacket& packet) { intake_.leave(packet); }

  // Whether the frame has a packet.
  [[nodiscard]] bool is_begun() const { return intake_.packets_accepted() > 0; }

  // Whether every sensor has delivered its scan.
  [[nodiscard]] bool is_complete() const { return intake_.is_complete(); }

  // Whether the frame's time is over.
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return now_us >= deadline_us(); }
  [[nodiscard]] std::uint64_t deadline_us() const;

  // Counted from 0; wraps.
  [[nodiscard]] std::uint32_t number() const { return number_; }

  // finish() completes the grid, and calls lap(stage) after each stage with its stream::StageTicks.
  // end_fusion() is its last step, for callers that fuse the buffered packets themselves.
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

  // Writes the frame's part of the header and of the end message.
  void describe(std::uint64_t now_us, stream::Header& header, stream::FrameEnd& end) const;

  // The same as SharedFusion::release().
  template <typename Visit>
  void release(Visit&& visit) {
    fusion_.release(visit);
  }

  // Begins the next frame. This one must be closed and its grid clear.
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

  // Members aligned to a cache line come first.
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

// Handles one datagram, if it is a sensor's packet. Calls fuse(packet) if the packet belongs to the
// open frame. Calls close() if the frame ends before or with this packet.
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
