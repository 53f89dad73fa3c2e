#include "tools/view/sources.hpp"

#include <chrono>

#include "tools/receive/udp_receiver.hpp"

namespace iog::tools::view {
namespace {

constexpr std::chrono::milliseconds kTendEvery{50};

class StreamSource : public Source {
 public:
  StreamSource(const std::string& address, std::uint16_t port) : receiver_(address, port) {}

  [[nodiscard]] std::string kind() const override { return "stream"; }

  void run(Viewer& viewer) override {
    Clock::time_point last_arrival = Clock::now();
    while (!receiver_.has_ended()) {
      const bool has_arrived = take(viewer);
      const Clock::time_point now = Clock::now();
      if (has_arrived) {
        last_arrival = now;
      } else if (now - last_arrival > FrameAssembler::kLongestSilence) {
        viewer.note_silence();
        last_arrival = now;
      }
      viewer.tend(receiver_.overflow());
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool take(Viewer& viewer) {
    const UdpReceiver::Messages messages = receiver_.take(kTendEvery);
    for (const UdpReceiver::Message& message : messages) {
      viewer.take(message.bytes, message.time_us);
    }
    return !messages.empty();
  }

  UdpReceiver receiver_;
};

}  // namespace

std::unique_ptr<Source> make_stream_source(const std::string& address, std::uint16_t port) {
  return std::make_unique<StreamSource>(address, port);
}

}  // namespace iog::tools::view
