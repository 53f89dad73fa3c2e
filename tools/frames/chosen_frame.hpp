// The one frame of a run that is drawn: the one that was asked for; else the last of those in which
// the most sensors have delivered a whole scan. A run that ends within a turn ends with a part of a
// frame, and that is not what a person wants to see of it.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <utility>

#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

class ChosenFrame {
 public:
  // number: among the frames with evidence, from 0.
  explicit ChosenFrame(std::optional<std::uint64_t> number = std::nullopt) : number_(number) {}

  // Frames in their order.
  void offer(GridFrame&& frame) {
    if (frame.header.has_evidence() &&
        (number_ ? frame.evidence_number == *number_ : !is_poorer(frame.header))) {
      frame_ = std::move(frame);
    }
  }

  [[nodiscard]] const std::optional<GridFrame>& get() const { return frame_; }

 private:
  [[nodiscard]] bool is_poorer(const stream::Header& header) const {
    return frame_ &&
           std::popcount(header.complete_sensors) < std::popcount(frame_->header.complete_sensors);
  }

  std::optional<std::uint64_t> number_;
  std::optional<GridFrame> frame_;
};

}  // namespace iog::tools
