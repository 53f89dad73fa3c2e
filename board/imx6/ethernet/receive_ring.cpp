#include "ethernet/receive_ring.hpp"

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

bool ReceiveRing::filled() const {
  if ((flags() & receive_flag::kEmpty) != 0) {
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
