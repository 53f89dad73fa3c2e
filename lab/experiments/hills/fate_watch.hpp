// What becomes of each point of a packet, as the target judges it: by the height band of its car or
// by the ground that its sensor has seen.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "app/frame.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

class FateWatch {
 public:
  // vehicle outlives it.
  explicit FateWatch(const vehicle::Vehicle& vehicle);

  // The fates of the points of a sensor's packet, in the order of its decoder; none if it was
  // dropped. Valid until the next call. Packets come as they do to the target.
  const std::vector<vehicle::Fate>& take(const tools::CapturedDatagram& datagram);

 private:
  void close_frame(std::uint64_t now_us);

  const vehicle::Vehicle* vehicle_;
  tools::CaptureClock clock_;
  std::unique_ptr<app::Frame> frame_;  // too large for the stack
  std::vector<vehicle::Fate> fates_;
};

}  // namespace iog::lab
