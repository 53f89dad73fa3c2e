#include "tools/view/sources.hpp"

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "tools/formats/capture/capture_clock.hpp"
#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/identity/vehicle_fit.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/receive/udp_receiver.hpp"
#include "tools/replay/pace.hpp"
#include "tools/replay/udp_sender.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "tools/view/sensor_target.hpp"

namespace iog::tools::view {
namespace {

constexpr std::chrono::milliseconds kTendEvery{50};

class StreamSource : public Source {
 public:
  StreamSource(const std::string& address, std::uint16_t port, std::uint16_t forward_port)
      : receiver_(address, port) {
    if (forward_port != 0) {
      forward_.emplace("127.0.0.1", std::vector{forward_port});
    }
  }

  [[nodiscard]] std::string kind() const override { return "stream"; }

  void run(Viewer& viewer) override {
    Clock::time_point last_arrival = Clock::now();
    while (!was_interrupted()) {
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
    for (const std::vector<std::byte>& message : messages) {
      if (forward_) {
        static_cast<void>(forward_->send(0, message));
      }
      viewer.take(message);
    }
    return !messages.empty();
  }

  UdpReceiver receiver_;
  std::optional<UdpSender> forward_;
};

class CaptureSource : public Source {
 public:
  explicit CaptureSource(const CaptureOptions& options)
      : options_(options), car_(&find_vehicle(options.vehicle)), pace_(options.speed) {
    PcapReader capture(options_.path);
    CaptureIdentity others;
    const std::optional<CapturedDatagram> first = next(capture, &others);
    if (!first) {
      throw UsageError(options_.path + ": no grid to port " + std::to_string(options_.port) +
                       ", and " + others.refusal(*car_));
    }
    is_of_target_ = !takes_port(*car_, first->destination.port);
    if (!is_of_target_) {
      demand_fit(options_.path, *car_);
    }
  }

  [[nodiscard]] std::string kind() const override {
    return is_of_target_ ? "recording" : "capture";
  }

  void run(Viewer& viewer) override {
    // A short recording would be over before anybody has opened the page.
    while (!viewer.is_watched() && !was_interrupted()) {
      rest(viewer);
    }
    play(viewer);
    while (options_.loops && !was_interrupted()) {
      if (is_of_target_) {
        viewer.begin_again();
      }
      play(viewer);
    }
    if (target_) {
      target_->finish();
    }
    // The last picture stays, and says that it is the last one.
    viewer.note_end();
    while (!was_interrupted()) {
      rest(viewer);
    }
  }

 private:
  static void rest(Viewer& viewer) {
    viewer.tend();
    std::this_thread::sleep_for(kTendEvery);
  }

  // The next datagram that can be shown. others: who is told of those before it.
  [[nodiscard]] std::optional<CapturedDatagram> next(PcapReader& capture,
                                                     CaptureIdentity* others = nullptr) const {
    while (std::optional<CapturedDatagram> datagram = capture.next()) {
      if (takes_port(*car_, datagram->destination.port) ||
          datagram->destination.port == options_.port) {
        return datagram;
      }
      if (others != nullptr) {
        others->add(*datagram);
      }
    }
    return std::nullopt;
  }

  void play(Viewer& viewer) {
    PcapReader capture(options_.path);
    CaptureClock clock;
    std::optional<CapturedDatagram> datagram = next(capture);
    while (datagram && !was_interrupted()) {
      now_us_ = round_start_us_ + clock.move_to(datagram->time_us);
      datagram->time_us = now_us_;
      pace_.wait_for(now_us_);
      show(*datagram, viewer);
      viewer.tend();
      datagram = next(capture);
    }
    // Another round begins one frame after the last one's end.
    round_start_us_ = now_us_ + car_->vehicle->frame_period_us;
  }

  void show(const CapturedDatagram& datagram, Viewer& viewer) {
    if (!takes_port(*car_, datagram.destination.port)) {
      viewer.take(datagram.payload);
      return;
    }
    if (!target_) {
      target_ = std::make_unique<SensorTarget>(*car_, viewer);
    }
    target_->take(datagram, nullptr);
  }

  CaptureOptions options_;
  const CatalogueEntry* car_;
  Pace pace_;
  bool is_of_target_ = false;  // a recorded stream
  std::unique_ptr<SensorTarget> target_;
  std::uint64_t round_start_us_ = 0;
  std::uint64_t now_us_ = 0;
};

}  // namespace

std::unique_ptr<Source> make_stream_source(const std::string& address, std::uint16_t port,
                                           std::uint16_t forward_port) {
  return std::make_unique<StreamSource>(address, port, forward_port);
}

std::unique_ptr<Source> make_capture_source(const CaptureOptions& options) {
  return std::make_unique<CaptureSource>(options);
}

}  // namespace iog::tools::view
