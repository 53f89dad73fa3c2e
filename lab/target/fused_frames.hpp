// The frames of a capture, fused as the firmware fuses them, for whoever wants to look at the grid.
#pragma once

#include <cstdint>
#include <utility>

#include "app/frame_engine.hpp"
#include "lidar/scan_point.hpp"
#include "playback.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

// A target of play(). Calls visit(view) when a frame is complete, before its grid is cleared.
template <typename Visit>
class FusedFrames {
 public:
  FusedFrames(const vehicle::Vehicle& vehicle, Visit visit)
      : visit_(std::move(visit)), engine_(vehicle, kReplayer) {}

  void take(const vehicle::Sensor& /*sensor*/, const intake::Datagram& datagram,
            std::uint32_t /*received*/, std::uint64_t now_us) {
    using Outcome = app::FrameEngine::Outcome;
    const auto packet = engine_.receive(datagram);
    Outcome outcome = packet ? engine_.classify(*packet) : Outcome::kDropped;
    if (outcome == Outcome::kNextFrame) {
      close_frame(now_us);
      outcome = engine_.classify(*packet);
    }
    if (outcome == Outcome::kThisFrame) {
      engine_.fuse(*packet, now_us);
    }
    if (engine_.is_complete()) {
      close_frame(now_us);
    }
  }
  void tick(std::uint64_t now_us) {
    if (engine_.is_overdue(now_us)) {
      close_frame(now_us);
    }
  }
  [[nodiscard]] std::uint64_t deadline_us() const { return engine_.deadline_us(); }

 private:
  void close_frame(std::uint64_t now_us) {
    engine_.finish();
    visit_(engine_.view());
    engine_.fusion().clear();
    engine_.start_next(now_us);
  }

  Visit visit_;
  app::FrameEngine engine_;
};

}  // namespace iog::lab
