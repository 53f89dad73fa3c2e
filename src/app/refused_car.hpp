// Runs a target without a valid car block. Such a target computes no grid. It answers ARP and ping
// as usual, and ignores datagrams. Once a second, the target sends its peer a message that states
// why the car block was rejected (docs/spec.md 3.11).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "app/loop.hpp"
#include "app/message_sender.hpp"
#include "stream/car_refusal.hpp"

namespace iog::app {

inline constexpr std::uint64_t kRefusalPeriodUs = 1'000'000;

// The text in `refusal` must outlive this object.
template <Machine M>
class RefusedCar {
 public:
  RefusedCar(M& machine, MachinePlatform<M>& platform, const stream::CarRefusal& refusal)
      : machine_(&machine), platform_(&platform), messages_(platform), refusal_(refusal) {}

  // Runs one pass of the loop. Returns true if Ethernet frames are still waiting.
  bool pass() {
    leave_datagrams();
    const std::uint64_t now_us = machine_->clock().now_us();
    if (platform_->host().peer_known() && now_us >= next_us_) {
      next_us_ = now_us + kRefusalPeriodUs;
      speak(now_us);
    }
    machine_->ethernet().pump();
    machine_->watchdog().service();
    return !machine_->ethernet().receive().empty();
  }

 private:
  void leave_datagrams() {
    for (int left = 0; left < kMaxDatagramsPerPass; ++left) {
      if (!platform_->host().poll(machine_->clock().now_us())) {
        return;
      }
    }
  }

  void speak(std::uint64_t now_us) {
    const stream::Header header{.closed_us = now_us, .run_number = platform_->run_number()};
    messages_.send(header, stream::MessageType::kCarRefused, [this](std::span<std::byte> body) {
      return stream::write_car_refusal(refusal_, body);
    });
  }

  M* machine_;
  MachinePlatform<M>* platform_;
  MessageSender<MachinePlatform<M>> messages_;
  stream::CarRefusal refusal_;
  std::uint64_t next_us_ = 0;
};

// Never returns.
template <Machine M>
[[noreturn]] void run_refused(M& machine, MachinePlatform<M>& platform,
                              const stream::CarRefusal& refusal) {
  RefusedCar<M> refused(machine, platform, refusal);
  for (;;) {
    if (!refused.pass()) {
      machine.idle();
    }
  }
}

// Call this function if the target does not know its own address. The function sends nothing and
// never returns.
template <Machine M>
[[noreturn]] void run_mute(M& machine) {
  for (;;) {
    machine.watchdog().service();
    machine.idle();
  }
}

}  // namespace iog::app
