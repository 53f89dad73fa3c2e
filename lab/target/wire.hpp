// The firmware's Ethernet port in an image of the benchmark. QEMU's controller is behind it, to
// which no network is connected: what is sent leaves at once, and what comes is delivered here, as
// the controller's DMA would do it.
#pragma once

#include <cstddef>
#include <span>

#include "ethernet/enet.hpp"

namespace iog::lab {

class Wire {
 public:
  // The machine has one.
  static Wire& of_machine();

  [[nodiscard]] imx6::EnetPort& port() { return port_; }

  [[nodiscard]] imx6::L2Cache& cache() { return cache_; }

  // A frame comes, and the one before is done with. Nothing of it is modelled: DMA costs no core
  // anything. False if it is longer than a frame of the port's.
  [[nodiscard]] bool deliver(std::span<const std::byte> frame);

  // The frame that was delivered, as the port passes it on; empty if it dropped it.
  [[nodiscard]] std::span<const std::byte> receive() { return port_.receive(); }

 private:
  Wire();

  imx6::EnetPort port_;  // refers to the next two, and asks them nothing before start()
  imx6::L2Cache cache_;
  std::size_t next_ = 0;  // the buffer that the controller fills next
  imx6::GptClock clock_;
};

}  // namespace iog::lab
