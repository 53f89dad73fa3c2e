#include "wire.hpp"

#include <algorithm>

#include "lab/a9_model/marker.hpp"
#include "peripherals.hpp"
#include "require/require.hpp"

namespace iog::lab {
namespace {

constexpr std::size_t kFcsBytes = 4;
constexpr imx6::MacAddress kAddress{0x02, 0, 0, 0, 0, 1};

}  // namespace

Wire& Wire::of_machine() {
  static Wire wire;
  return wire;
}

Wire::Wire()
    : port_(imx6::Enet(imx6::enet), imx6::EnetPort::rings_of(imx6::enet_memory), cache_, clock_),
      cache_(imx6::pl310),
      clock_(imx6::gpt) {
  clock_.start();
  port_.start(kAddress);
}

bool Wire::deliver(std::span<const std::byte> frame) {
  if (!port_.receive().empty()) {
    port_.release();
  }
  if (frame.size() > board::kMaxFrameBytes) {
    return false;
  }
  a9_model::pause();
  imx6::Descriptor& descriptor = imx6::enet_memory.receive_descriptors[next_];
  const std::uint16_t flags = machine::load(descriptor.flags);
  require((flags & imx6::receive_flag::kEmpty) != 0);
  std::ranges::copy(frame, imx6::enet_memory.receive_buffers.begin() +
                               next_ * imx6::DescriptorFormat::kReceiveBytes);
  machine::store(descriptor.length, static_cast<std::uint16_t>(frame.size() + kFcsBytes));
  machine::store(descriptor.flags, static_cast<std::uint16_t>((flags & imx6::receive_flag::kWrap) |
                                                              imx6::receive_flag::kLast));
  next_ = next_ + 1 == imx6::EnetMemory::kReceiveFrames ? 0 : next_ + 1;
  a9_model::resume();
  return true;
}

}  // namespace iog::lab
