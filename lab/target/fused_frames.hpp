// The frames of a capture, fused as the firmware fuses them, for whoever wants to look at the grid.
#pragma once

#include <cstdint>
#include <utility>

#include "app/frame.hpp"
#include "playback.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

// A target of play(). Calls visit(view) when a frame is complete, before its grid is cleared.
template <typename Visit>
class FusedFrames {
 public:
  FusedFrames(const vehicle::Vehicle& vehicle, Visit visit)
      : visit_(std::move(visit)), frame_(vehicle, kReplayer) {}

  void take(const vehicle::Sensor& /*sensor*/, const intake::Datagram& datagram,
            std::uint32_t /*received*/, std::uint64_t now_us) {
    app::take_packet(
        frame_, frame_.receive(datagram),
        [&](const intake::SensorPacket& packet) { frame_.fuse(packet, now_us, work::Crew()); },
        [&] { close_frame(now_us); });
  }
  void tick(std::uint64_t now_us) {
    if (frame_.is_overdue(now_us)) {
      close_frame(now_us);
    }
  }
  [[nodiscard]] std::uint64_t deadline_us() const { return frame_.deadline_us(); }

 private:
  void close_frame(std::uint64_t now_us) {
    frame_.finish(work::Crew(), [](auto /*stage*/) {});
    visit_(frame_.fusion().own().view());
    frame_.fusion().own().clear();
    frame_.start_next(now_us);
  }

  Visit visit_;
  app::Frame frame_;
};

}  // namespace iog::lab
