#include "ethernet/receive_ring.hpp"

#include <algorithm>

namespace iog::zcu102 {

void ReceiveRing::start() {
  for (std::size_t index = 0; index < descriptors_.size(); ++index) {
    const std::uint64_t address = machine::bus_address(buffer(index).front());
    machine::store(descriptors_[index].address_high, high_half(address));
    give(index);
  }
  next_ = 0;
  machine::barrier();
}

std::size_t ReceiveRing::waiting() const {
  return static_cast<std::size_t>(std::ranges::count_if(descriptors_, is_filled));
}

bool ReceiveRing::filled() const {
  if (!is_filled(next())) {
    return false;
  }
  // Neither buffer nor length may be read earlier than the bit that says they are ours.
  machine::barrier();
  return true;
}

void ReceiveRing::recycle() {
  give(next_);
  next_ = next_ + 1 == descriptors_.size() ? 0 : next_ + 1;
}

void ReceiveRing::give(std::size_t index) {
  Descriptor& descriptor = descriptors_[index];
  machine::store(descriptor.control, std::uint32_t{0});
  const std::uint32_t wrap = index + 1 == descriptors_.size() ? receive_flag::kWrap : 0;
  hand_over(descriptor.address, low_half(machine::bus_address(buffer(index).front())) | wrap);
}

}  // namespace iog::zcu102
