#include "lab/experiments/hills/fate_watch.hpp"

#include "lab/experiments/perceiver.hpp"
#include "tools/vehicles/packet_points.hpp"

namespace iog::lab {

FateWatch::FateWatch(const vehicle::Vehicle& vehicle)
    : vehicle_(&vehicle), frame_(std::make_unique<app::Frame>(vehicle, kReplayer)) {}

const std::vector<vehicle::Fate>& FateWatch::take(const tools::CapturedDatagram& datagram) {
  fates_.clear();
  const std::uint64_t now_us = clock_.move_to(datagram.time_us);
  while (frame_->is_overdue(now_us)) {
    close_frame(frame_->deadline_us());
  }
  app::take_packet(
      *frame_, frame_->receive({kReplayer, datagram.destination.port, datagram.payload}),
      [&](const intake::SensorPacket& packet) {
        frame_->accept(packet, now_us);
        frame_->fusion().own().add_all(vehicle_->sensors[packet.sensor],
                                       tools::ListedPacket(packet.packet),
                                       [this](vehicle::Fate fate) { fates_.push_back(fate); });
      },
      [&] { close_frame(now_us); });
  return fates_;
}

// Nobody wants its grid.
void FateWatch::close_frame(std::uint64_t now_us) {
  frame_->fusion().own().clear();
  frame_->end_fusion();
  frame_->start_next(now_us);
}

}  // namespace iog::lab
