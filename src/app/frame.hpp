// The frame that is currently open. This class determines which packets belong to the frame and
// when the frame ends, and it records the outcomes of the packets. Callers pass the time and the
// datagrams as arguments, so this class needs neither a clock nor a network. The target and `iog
// fuse` therefore produce the same frames.
//
// A frame starts with its first packet. The frame ends when the first of these events occurs: every
// sensor has delivered its scan, a sensor's next scan begins, or the vehicle's frame period has
// passed. If no packets arrive, an empty frame is closed every two periods so that missing data is
// reported.
//
// A single core fuses each packet on arrival. If a dense lidar sends more points than one core can
// process, several cores share the work. The lidar's packets are then buffered until there are
// enough to divide among the cores. The cores fuse the parts in a round while the next packets
// arrive. The parts are merged when the frame ends (fusion/shared_fusion.hpp). The grid does not
// depend on the number of cores. If the frame has classes, all packets are buffered until the frame
// ends (app/perception_engine.hpp).
#pragma once

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

// Returns true if several cores may fuse this car's packets on arrival. Shared fusion requires a
// dense lidar and a fusion rule under which the parts of a frame can be merged. For four LUX units,
// one core is enough, because fusing their frame takes less time than splitting it between two
// cores.
[[nodiscard]] bool is_fused_together(const vehicle::Vehicle& vehicle);

// Specifies whether points are fused when their packet arrives or when the frame ends.
enum class Fusing : std::uint8_t { kAsTheyCome, kAtItsEnd };

// A Frame uses 19 MB, so it must be in static memory.
class Frame {
 public:
  using Outcome = intake::Intake::Outcome;

  // `vehicle` and `space` must outlive this object. Together, the scans of all sensors must not
  // mark more than grid::kMaxMarks cells. The replayer at `replayer_ipv4` may send on behalf of any
  // sensor. The address is 0 if there is no replayer.
  Frame(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4,
        fusion::HelpersSpace space = {}, Fusing fusing = Fusing::kAsTheyCome);

  // Starts the timer that closes an empty frame. Call this function before the first datagram.
  void start(std::uint64_t now_us) { opened_us_ = now_us; }

  // Decodes the datagram as a packet from a sensor. Returns nothing if the datagram was dropped.
  // The payload must outlive the packet.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram) {
    return intake_.receive(datagram);
  }

  // Returns true if the datagram is addressed to a sensor's port and comes from a sender that may
  // send on behalf of that sensor.
  [[nodiscard]] bool listens_to(const intake::Datagram& datagram) const {
    return intake_.listens_to(datagram);
  }

  // Determines whether the packet belongs to the open frame. If the packet belongs to the next
  // frame, close the open frame and call classify() again. A packet that does not fit into the open
  // frame's buffer belongs to the next frame.
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet) {
    const Outcome outcome = intake_.classify(packet);
    const bool is_full = fusing_ == Fusing::kAtItsEnd && !fusion_.packets().fits(packet);
    return outcome == Outcome::kThisFrame && is_full ? Outcome::kNextFrame : outcome;
  }

  // Call these functions only after classify() has returned kThisFrame. `accept()` counts the
  // packet. `keep()` counts the packet and buffers it with its measurement time. `fuse()` counts
  // the packet and fuses its points on the cores of the crew, either immediately or when a round
  // begins.
  void accept(const intake::SensorPacket& packet, std::uint64_t now_us);
  void keep(const intake::SensorPacket& packet, std::uint64_t now_us, std::uint64_t measured_us) {
    accept(packet, now_us);
    fusion_.packets().keep(packet, measured_us);
  }
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us, const work::Crew& crew);

  // Returns the fusion of this frame, including the buffered packets.
  [[nodiscard]] fusion::SharedFusion& fusion() { return fusion_; }
  [[nodiscard]] const fusion::SharedFusion& fusion() const { return fusion_; }

  // Sheds a packet that has waited too long, and counts its points as "not taken".
  void leave(const intake::SensorPacket& packet) { intake_.leave(packet); }

  // Returns true if the frame has at least one packet.
  [[nodiscard]] bool is_begun() const { return intake_.packets_accepted() > 0; }

  // Returns true if every sensor has delivered its scan.
  [[nodiscard]] bool is_complete() const { return intake_.is_complete(); }

  // Returns true if the frame's deadline has passed.
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return now_us >= deadline_us(); }
  [[nodiscard]] std::uint64_t deadline_us() const;

  // Returns the frame number, which starts at 0 and wraps around.
  [[nodiscard]] std::uint32_t number() const { return number_; }

  // `finish()` completes the grid. After each stage, it calls lap() with the corresponding member
  // of stream::StageTicks. `end_fusion()` is the last step of finish(). Callers that fuse the
  // buffered packets themselves call only end_fusion().
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

  // Fills in the frame's fields in the header and in the end message.
  void describe(std::uint64_t now_us, stream::Header& header, stream::FrameEnd& end);

  // Equivalent to SharedFusion::release().
  template <typename Place, typename Visit>
  void release(Place&& place, Visit&& visit) {
    fusion_.release(place, visit);
  }

  // Begins the next frame. The current frame must be closed, and the grid must be cleared.
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

// Handles one datagram if it is a packet from a sensor. If the packet belongs to the next frame,
// first calls close(). Calls fuse(packet) unless the packet was dropped. If every sensor has then
// delivered its scan, calls close().
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
