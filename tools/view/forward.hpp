// Hands each datagram of what is shown on to another receiver on this PC.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/record/recording.hpp"
#include "tools/replay/udp_sender.hpp"

namespace iog::tools::view {

class Forward : public Recording {
 public:
  explicit Forward(std::uint16_t port) : sender_("127.0.0.1", std::vector{port}) {}

  // What nobody takes is lost, as on any network.
  void take_datagram(const CapturedDatagram& datagram) override {
    static_cast<void>(sender_.send(0, datagram.payload));
  }
  void take_frame(const RecordedFrame& /*frame*/) override {}
  void finish(const Facts& /*facts*/) override {}

 private:
  UdpSender sender_;
};

}  // namespace iog::tools::view
