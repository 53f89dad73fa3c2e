#include "ethernet/transmit_ring.hpp"

#include <algorithm>

namespace iog::imx6 {

void TransmitRing::start() {
  for (std::size_t index = 0; index < descriptors_.size(); ++index) {
    Descriptor& descriptor = descriptors_[index];
    machine::store(descriptor.length, std::uint16_t{0});
    machine::store(descriptor.flags,
                   index + 1 == descriptors_.size() ? transmit_flag::kWrap : std::uint16_t{0});
    machine::store(descriptor.buffer, machine::bus_address(buffers_[index * kBufferBytes]));
  }
  next_ = 0;
  queued_ = 0;
  in_flight_ = 0;
  cache_.drain_stores();
}

void TransmitRing::commit(std::size_t bytes) {
  // Only the length: the owner bit belongs to hand_over_queued().
  machine::store(descriptors_[next_].length, static_cast<std::uint16_t>(bytes));
  next_ = after(next_, 1);
  ++queued_;
}

std::size_t TransmitRing::hand_over_queued(std::size_t frames) {
  const std::size_t handed = std::min(frames, queued_);
  std::size_t index = after(next_, descriptors_.size() - queued_);
  // One drain for all: what these frames stored before reaches memory before any owner bit.
  if (handed != 0) {
    cache_.drain_stores();
  }
  for (std::size_t count = 0; count < handed; ++count) {
    Descriptor& descriptor = descriptors_[index];
    const auto wrap =
        static_cast<std::uint16_t>(machine::load(descriptor.flags) & transmit_flag::kWrap);
    machine::store(descriptor.flags,
                   static_cast<std::uint16_t>(transmit_flag::kReady | transmit_flag::kLast |
                                              transmit_flag::kCrc | wrap));
    index = after(index, 1);
  }
  queued_ -= handed;
  in_flight_ += handed;
  return handed;
}

void TransmitRing::reclaim() {
  std::size_t oldest = after(next_, 2 * descriptors_.size() - queued_ - in_flight_);
  while (in_flight_ != 0 &&
         (machine::load(descriptors_[oldest].flags) & transmit_flag::kReady) == 0) {
    oldest = after(oldest, 1);
    --in_flight_;
    ++sent_;
  }
}

// index < size and steps <= 2 * size, so two subtractions are enough; the core has no division.
std::size_t TransmitRing::after(std::size_t index, std::size_t steps) const {
  std::size_t sum = index + steps;
  while (sum >= descriptors_.size()) {
    sum -= descriptors_.size();
  }
  return sum;
}

}  // namespace iog::imx6
