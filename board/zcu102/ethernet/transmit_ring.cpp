#include "ethernet/transmit_ring.hpp"

#include <algorithm>

namespace iog::zcu102 {

void TransmitRing::start() {
  for (std::size_t index = 0; index < descriptors_.size(); ++index) {
    Descriptor& descriptor = descriptors_[index];
    const std::uint64_t address = machine::bus_address(buffer(index).front());
    const std::uint32_t wrap = index + 1 == descriptors_.size() ? transmit_flag::kWrap : 0;
    machine::store(descriptor.control, transmit_flag::kOurs | wrap);
    machine::store(descriptor.address, low_half(address));
    machine::store(descriptor.address_high, high_half(address));
  }
  order_.start();
  machine::barrier();
}

// Only the length: the owner bit belongs to hand_over_queued().
void TransmitRing::commit(std::size_t bytes) {
  Descriptor& descriptor = descriptors_[order_.next()];
  const std::uint32_t wrap = machine::load(descriptor.control) & transmit_flag::kWrap;
  machine::store(descriptor.control,
                 transmit_flag::kOurs | wrap | static_cast<std::uint32_t>(bytes));
  order_.commit();
}

std::size_t TransmitRing::hand_over_queued(std::size_t frames) {
  const std::size_t handed = std::min(frames, order_.queued());
  for (std::size_t count = 0; count < handed; ++count) {
    Descriptor& descriptor = descriptors_[order_.oldest_queued()];
    const std::uint32_t kept = transmit_flag::kWrap | transmit_flag::kLength;
    hand_over(descriptor.control,
              transmit_flag::kLast | (machine::load(descriptor.control) & kept));
    order_.hand_over();
  }
  return handed;
}

void TransmitRing::reclaim() {
  while (order_.in_flight() != 0 &&
         (machine::load(descriptors_[order_.oldest_in_flight()].control) & transmit_flag::kOurs) !=
             0) {
    order_.reclaim();
  }
}

}  // namespace iog::zcu102
