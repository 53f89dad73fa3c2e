#include "tools/fuse/offline_target.hpp"

#include <chrono>
#include <utility>

namespace iog::tools {

OfflineTarget::OfflineTarget(const vehicle::Vehicle& vehicle, MessageHandler on_message,
                             Stopwatch stopwatch)
    : vehicle_(&vehicle),
      platform_(std::move(on_message), stopwatch),
      pipeline_(vehicle, kReplayer, platform_, 0) {}

OfflineTarget::Closed OfflineTarget::take(const CapturedDatagram& datagram) {
  Closed closed;
  const std::uint64_t now_us = clock_.move_to(datagram.time_us);
  while (pipeline_.deadline_us() <= now_us) {
    pipeline_.tick(pipeline_.deadline_us());
  }
  closed.before = platform_.take_evidence_frames();
  pipeline_.take({.source_ipv4 = kReplayer,
                  .destination_port = datagram.destination.port,
                  .payload = datagram.payload},
                 now_us);
  // A frame that is open and one period old at most has begun with this datagram, so the frame that
  // was closed just now had been closed before it. Otherwise the datagram completed it.
  const bool has_opened = pipeline_.deadline_us() == now_us + vehicle_->frame_period_us;
  const unsigned by_datagram = platform_.take_evidence_frames();
  const bool began_next = by_datagram == 2 || (by_datagram == 1 && has_opened);
  closed.before += began_next ? 1U : 0U;
  closed.after = by_datagram - (began_next ? 1U : 0U);
  is_open_ = closed.after == 0;
  return closed;
}

void OfflineTarget::finish() {
  if (is_open_) {
    pipeline_.tick(pipeline_.deadline_us());
    is_open_ = false;
  }
}

bool OfflinePlatform::send_message(std::span<const std::byte> message) {
  stream::Header header;
  std::span<const std::byte> body;
  const std::span content = message.subspan(protection::kProtectionBytes);
  if (stream::read_header(content, header, body) == stream::ReadStatus::kOk &&
      header.type == stream::MessageType::kFrameEnd && header.has_evidence()) {
    ++evidence_frames_;
  }
  on_message_(message);
  return true;
}

std::uint32_t OfflinePlatform::ticks() const {
  using std::chrono::microseconds;
  if (stopwatch_ == Stopwatch::kStands) {
    return 0;
  }
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<std::uint32_t>(std::chrono::duration_cast<microseconds>(now).count());
}

}  // namespace iog::tools
