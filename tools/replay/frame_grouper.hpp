// Cuts the datagrams of a capture into frames, by running the target's own pipeline on them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/fuse/offline_target.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {

class FrameGrouper {
 public:
  using Source = std::function<std::optional<CapturedDatagram>()>;

  // source: the datagrams for the vehicle, in their order; poses are of the frame in which they
  // come.
  FrameGrouper(const vehicle::Vehicle& vehicle, Source source);

  // The datagrams of the next frame with evidence; with them those that are dropped on the way to
  // it. Empty at the end.
  [[nodiscard]] std::vector<CapturedDatagram> next();

 private:
  Source source_;
  vehicle::Vehicle vehicle_;  // its classes cut no frame
  std::unique_ptr<OfflineTarget> target_;
  std::vector<CapturedDatagram> begun_;  // of the frame that is open
  bool is_begun_over_ = false;
};

}  // namespace iog::tools
