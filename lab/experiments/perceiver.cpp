#include "lab/experiments/perceiver.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace iog::lab {

Perceiver::Perceiver(const vehicle::Vehicle& vehicle, std::span<const std::uint8_t> map,
                     OnFrame on_frame)
    : on_frame_(std::move(on_frame)),
      frame_(std::make_unique<app::Frame>(vehicle, kReplayer, fusion::HelpersSpace{},
                                          app::Fusing::kAtItsEnd)),
      engine_(std::make_unique<app::PerceptionEngine>(*frame_, vehicle, kReplayer)) {
  if (!map.empty()) {
    engine_->begin_with_map(map);
  }
}

void Perceiver::take(const tools::CapturedDatagram& datagram) {
  const std::uint64_t now_us = clock_.move_to(datagram.time_us);
  has_fused_newest_ = false;
  while (frame_->is_overdue(now_us)) {
    close_frame(frame_->deadline_us());
  }
  const intake::Datagram received{kReplayer, datagram.destination.port, datagram.payload};
  app::take_packet(
      *frame_, engine_->receive(received, now_us) ? std::nullopt : frame_->receive(received),
      [&](const intake::SensorPacket& packet) {
        engine_->keep(packet, now_us);
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
  std::array<std::byte, geometry::kTileCells> unused{};
  frame_->release([&unused] { return std::span(unused); },
                  [](std::size_t /*tile*/, auto /*cells*/) {});
  engine_->describe(end_);
  ++frames_;
  frame_->start_next(now_us);
  engine_->start_next();
  if (on_frame_) {
    on_frame_(*this);
  }
}

}  // namespace iog::lab
