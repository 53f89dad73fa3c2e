// From whoever receives a stream to whoever serves it, on another thread: the newest frame. What
// has not been fetched when the next one comes is left out; nothing else ever waits.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "tools/record/recording.hpp"

namespace iog::tools::foxglove {

// A frame, and what was known when it had come.
struct LiveFrame {
  std::uint64_t number = 0;  // of all frames that came, from 1
  GridFrame frame;
  LiveGrid live;
  LiveClasses classes;
  std::uint64_t time_us = 0;  // since 1970, by this PC's clock
  std::vector<SeenPoint> points;
  std::vector<CapturedDatagram> datagrams;  // since the frame before was complete

  [[nodiscard]] RecordedFrame recorded() const {
    return {
        .frame = &frame, .live = &live, .classes = &classes, .time_us = time_us, .points = points};
  }
};

class LiveFeed : public Recording {
 public:
  // Datagrams that can wait for a frame; a frame has some hundred. Where none is completed, all
  // that wait are no frame's, and go.
  static constexpr std::size_t kMostDatagrams = 4096;

  // Called after each frame, by the thread that takes it.
  void on_news(std::function<void()> handler);

  // Whether somebody listens. While nobody does, nothing is kept.
  void listen(bool is_listening);

  // Null if there is none since somebody listens.
  [[nodiscard]] std::shared_ptr<const LiveFrame> newest() const;

  void take_datagram(const CapturedDatagram& datagram) override;
  void take_frame(const RecordedFrame& frame) override;
  void finish(const Facts& /*facts*/) override {}

 private:
  std::atomic<bool> is_listening_ = false;
  std::uint64_t frames_ = 0;                 // of the thread that takes
  std::vector<CapturedDatagram> datagrams_;  // likewise
  mutable std::mutex mutex_;                 // for what follows
  std::function<void()> on_news_;
  std::shared_ptr<const LiveFrame> newest_;
};

}  // namespace iog::tools::foxglove
