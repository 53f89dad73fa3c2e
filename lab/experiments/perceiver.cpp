#include "lab/experiments/perceiver.hpp"

#include <utility>

#include "app/frame.hpp"

namespace iog::lab {

Perceiver::Perceiver(const vehicle::Vehicle& vehicle, std::span<const std::uint8_t> map,
                     OnFrame on_frame)
    : on_frame_(std::move(on_frame)),
      engine_(std::make_unique<app::PerceptionEngine>(vehicle, kReplayer, app::HelpersSpace{})) {
  if (!map.empty()) {
    engine_->begin_with_map(map);
  }
}

void Perceiver::take(const tools::CapturedDatagram& datagram) {
  const std::uint64_t now_us = clock_.move_to(datagram.time_us);
  has_fused_newest_ = false;
  while (engine_->is_overdue(now_us)) {
    close_frame(engine_->deadline_us());
  }
  app::take_datagram(
      *engine_, {kReplayer, datagram.destination.port, datagram.payload}, now_us,
      [&](const intake::SensorPacket& packet) {
        engine_->fuse(packet, now_us, work::Crew());
        has_fused_newest_ = true;
      },
      [&] { close_frame(now_us); });
}

std::vector<std::int8_t> Perceiver::classes() const {
  const window::WindowView view = engine_->classes();
  return rows_of(view.area(),
                 [&view](std::size_t slot, auto& tile) { return view.copy_classes(slot, tile); });
}

void Perceiver::close_frame(std::uint64_t now_us) {
  engine_->finish(now_us, work::Crew(), [](auto /*stage*/) {});
  engine_->release([](std::size_t /*tile*/, auto /*cells*/) {});
  engine_->describe(end_);
  ++frames_;
  engine_->start_next(now_us);
  if (on_frame_) {
    on_frame_(*this);
  }
}

}  // namespace iog::lab
