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
  order_.start();
  cache_.drain_stores();
}

void TransmitRing::commit(std::size_t bytes) {
  // Only the length: the owner bit belongs to hand_over_queued().
  machine::store(descriptors_[order_.next()].length, static_cast<std::uint16_t>(bytes));
  order_.commit();
}

std::size_t TransmitRing::hand_over_queued(std::size_t frames) {
  const std::size_t handed = std::min(frames, order_.queued());
  // One drain for all: what these frames stored before reaches memory before any owner bit.
  if (handed != 0) {
    cache_.drain_stores();
  }
  for (std::size_t count = 0; count < handed; ++count) {
    Descriptor& descriptor = descriptors_[order_.oldest_queued()];
    const auto wrap =
        static_cast<std::uint16_t>(machine::load(descriptor.flags) & transmit_flag::kWrap);
    machine::store(descriptor.flags,
                   static_cast<std::uint16_t>(transmit_flag::kReady | transmit_flag::kLast |
                                              transmit_flag::kCrc | wrap));
    order_.hand_over();
  }
  return handed;
}

void TransmitRing::reclaim() {
  while (order_.in_flight() != 0 && (machine::load(descriptors_[order_.oldest_in_flight()].flags) &
                                     transmit_flag::kReady) == 0) {
    order_.reclaim();
  }
}

}  // namespace iog::imx6
