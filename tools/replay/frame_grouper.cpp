#include "tools/replay/frame_grouper.hpp"

#include <utility>

namespace iog::tools {

FrameGrouper::FrameGrouper(const vehicle::Vehicle& vehicle, Source source)
    : source_(std::move(source)), vehicle_(vehicle) {
  vehicle_.grids = vehicle::Grids::kIndexes;
  target_ = std::make_unique<OfflineTarget>(vehicle_, [](std::span<const std::byte>) {});
}

std::vector<CapturedDatagram> FrameGrouper::next() {
  if (std::exchange(is_begun_over_, false)) {
    return std::exchange(begun_, {});
  }
  while (std::optional<CapturedDatagram> datagram = source_()) {
    const OfflineTarget::Closed closed = target_->take(*datagram);
    if (closed.before > 0) {
      std::vector<CapturedDatagram> frame = std::exchange(begun_, {});
      begun_.push_back(std::move(*datagram));
      is_begun_over_ = closed.after > 0;
      return frame;
    }
    begun_.push_back(std::move(*datagram));
    if (closed.after > 0) {
      return std::exchange(begun_, {});
    }
  }
  return std::exchange(begun_, {});
}

}  // namespace iog::tools
