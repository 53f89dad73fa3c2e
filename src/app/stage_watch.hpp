// What the stages of a frame cost, by the platform's stopwatch.
#pragma once

#include <cstdint>

#include "app/platform.hpp"
#include "stream/message.hpp"

namespace iog::app {

template <Platform P>
class StageWatch {
 public:
  using Stage = std::uint32_t stream::StageTicks::*;

  // platform outlives the watch.
  explicit StageWatch(P& platform) : platform_(&platform) {}

  // What comes now is part of a stage.
  void start() { since_ = platform_->ticks(); }

  // It was part of this one; what comes now is part of the next.
  void lap(Stage stage) {
    const std::uint32_t now = platform_->ticks();
    ticks_.*stage += now - since_;
    since_ = now;
  }

  // As lap(), and the stage is the first of a new frame.
  void begin_frame(Stage stage) {
    ticks_ = {};
    lap(stage);
  }

  // Of the frame so far.
  [[nodiscard]] const stream::StageTicks& ticks() const { return ticks_; }

 private:
  P* platform_;
  std::uint32_t since_ = 0;
  stream::StageTicks ticks_{};
};

}  // namespace iog::app
