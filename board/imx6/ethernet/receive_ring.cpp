#include "ethernet/receive_ring.hpp"

#include <algorithm>

namespace iog::imx6 {

void ReceiveRing::start() {
  for (next_ = 0; next_ < descriptors_.size(); ++next_) {
    machine::store(next().length, std::uint16_t{0});
    machine::store(next().buffer, machine::bus_address(buffers_[next_ * kBufferBytes]));
    hand_over(next(), static_cast<std::uint16_t>(receive_flag::kEmpty | wrap()), cache_);
  }
  next_ = 0;
  cache_.drain_stores();
}

std::size_t ReceiveRing::waiting() const {
  return static_cast<std::size_t>(std::ranges::count_if(descriptors_, is_filled));
}

bool ReceiveRing::filled() const {
  if (!is_filled(next())) {
    return false;
  }
  // The buffer must not be read earlier than the flag that says it is ours.
  machine::barrier();
  return true;
}

std::span<std::byte> ReceiveRing::buffer() const {
  return buffers_.subspan(next_ * kBufferBytes, kBufferBytes);
}

void ReceiveRing::recycle() {
  machine::store(next().length, std::uint16_t{0});
  hand_over(next(), static_cast<std::uint16_t>(receive_flag::kEmpty | wrap()), cache_);
  next_ = next_ + 1 == descriptors_.size() ? 0 : next_ + 1;
}

std::uint16_t ReceiveRing::wrap() const {
  return next_ + 1 == descriptors_.size() ? receive_flag::kWrap : std::uint16_t{0};
}

}  // namespace iog::imx6
