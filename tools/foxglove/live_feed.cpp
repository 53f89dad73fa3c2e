#include "tools/foxglove/live_feed.hpp"

#include <utility>

#include "net/udp.hpp"

namespace iog::tools::foxglove {

void LiveFeed::on_news(std::function<void()> handler) {
  const std::lock_guard lock(mutex_);
  on_news_ = std::move(handler);
}

void LiveFeed::listen(bool is_listening) {
  const std::lock_guard lock(mutex_);
  is_listening_ = is_listening;
  if (!is_listening) {
    newest_.reset();
  }
}

std::shared_ptr<const LiveFrame> LiveFeed::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

void LiveFeed::take_datagram(const CapturedDatagram& datagram) {
  if (!is_listening_ || datagrams_.size() == kMostDatagrams) {
    datagrams_.clear();
  }
  if (is_listening_ && datagram.payload.size() <= net::kMaxUdpPayloadBytes) {
    datagrams_.push_back(datagram);
  }
}

void LiveFeed::take_frame(const RecordedFrame& frame) {
  ++frames_;
  std::vector<CapturedDatagram> datagrams = std::exchange(datagrams_, {});
  if (!is_listening_) {
    return;
  }
  auto newest = std::make_shared<const LiveFrame>(
      LiveFrame{.number = frames_,
                .frame = *frame.frame,
                .live = *frame.live,
                .classes = *frame.classes,
                .time_us = frame.time_us,
                .points = {frame.points.begin(), frame.points.end()},
                .datagrams = std::move(datagrams)});
  const std::lock_guard lock(mutex_);
  if (is_listening_) {
    newest_ = std::move(newest);
  }
  if (on_news_) {
    on_news_();
  }
}

}  // namespace iog::tools::foxglove
