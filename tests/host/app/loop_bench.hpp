// The loop on a machine that takes its time, with the traffic of three LUX.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include "app/loop.hpp"
#include "fake_machine.hpp"
#include "fakes/fake_ethernet_port.hpp"
#include "fakes/fake_platform.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/test_vehicles.hpp"
#include "net/frames.hpp"

namespace iog::app::testing {

using net::testing::Frame;
using net::testing::kConfig;
using tests::LuxMessage;
using tests::ThreeLux;
using vehicle::Fate;

inline constexpr std::uint64_t kPeriodUs = 40'000;
inline constexpr int kParts = 8;  // messages of a scan
inline constexpr std::size_t kPointsPerMessage = 25;
inline constexpr std::size_t kRingFrames = 256;

using Target = Pipeline<MachinePlatform<FakeMachine>, serial::GridSender>;

// How long a target takes.
struct Costs {
  std::uint64_t datagram_us = 0;  // for one that it takes
  std::uint64_t left_us = 0;      // for one that it leaves
  std::uint64_t close_us = 0;     // to close a frame
  std::uint64_t pass_us = 0;      // for what else is done in a pass
  std::uint64_t stranger_us = 0;  // for a datagram of a stranger
};

inline constexpr std::uint16_t kStrangersPort = 999;

struct SlowTarget {
  Target& target;
  MachinePlatform<FakeMachine>& platform;
  FakeClock& clock;
  Costs costs;

  void take(const intake::Datagram& datagram, std::uint64_t now_us) {
    const std::uint32_t frames = platform.frames();
    target.take(datagram, now_us);
    const bool is_strange = datagram.destination_port == kStrangersPort;
    clock.time_us += (is_strange ? costs.stranger_us : costs.datagram_us) +
                     (platform.frames() - frames) * costs.close_us;
  }
  void leave(const intake::Datagram& datagram, std::uint64_t now_us) {
    target.leave(datagram, now_us);
    clock.time_us += costs.left_us;
  }
  void tick(std::uint64_t now_us) {
    const std::uint32_t frames = platform.frames();
    target.tick(now_us);
    clock.time_us += (platform.frames() - frames) * costs.close_us;
  }
  [[nodiscard]] bool is_begun() const { return target.is_begun(); }
  [[nodiscard]] std::uint64_t deadline_us() const { return target.deadline_us(); }
};

// A datagram of the peer, who may speak for every sensor; without a UDP checksum.
inline Frame datagram_to(std::uint16_t port, const std::vector<std::byte>& payload) {
  Frame frame = net::testing::linux_udp_even();
  frame.resize(net::testing::kPayloadOffset);
  net::testing::put_be16(frame, net::testing::kIpOffset + 2, 28 + payload.size());
  net::testing::fix_ip_checksum(frame);
  net::testing::put_be16(frame, net::testing::kUdpOffset + 2, port);
  net::testing::put_be16(frame, net::testing::kUdpOffset + 4, 8 + payload.size());
  net::testing::put_be16(frame, net::testing::kUdpChecksumOffset, 0);
  std::ranges::copy(payload, std::back_inserter(frame));
  return frame;
}

// Three LUX at 25 Hz, each scan in eight messages, evenly over the period: 24 datagrams; and
// datagrams of a stranger to a port that nobody listens to.
class Traffic {
 public:
  // What has come by now, as far as the ring holds it.
  void arrive(std::uint64_t now_us, fakes::FakeEthernetPort& port) {
    while (std::min(next_us(), next_of_flood_us()) <= now_us) {
      if (next_us() <= next_of_flood_us()) {
        put(frame(), port);
        ++sent_;
      } else {
        put(stranger_, port);
        ++flood_sent_;
      }
    }
  }

  // From now on so many a second come of the stranger.
  void flood(std::uint64_t now_us, std::uint64_t per_second) {
    flood_from_us_ = now_us;
    flood_per_second_ = per_second;
    flood_sent_ = 0;
  }

  [[nodiscard]] std::uint64_t sent() const { return sent_; }
  [[nodiscard]] std::uint64_t scan() const { return sent_ / (3ULL * kParts); }

 private:
  [[nodiscard]] std::uint64_t next_us() const {
    return 1'000'000 + sent_ * kPeriodUs / (3ULL * kParts);
  }

  [[nodiscard]] std::uint64_t next_of_flood_us() const {
    return flood_per_second_ == 0 ? UINT64_MAX
                                  : flood_from_us_ + flood_sent_ * 1'000'000 / flood_per_second_;
  }

  static void put(const Frame& frame, fakes::FakeEthernetPort& port) {
    if (port.waiting() >= kRingFrames) {
      port.overflow();
    } else {
      port.arrive(frame);
    }
  }

  [[nodiscard]] Frame frame() const {
    const int part = static_cast<int>(sent_ / 3 % kParts);
    const int left = 1600 - 3200 * part / kParts;
    const int right = 1600 - 3200 * (part + 1) / kParts;
    LuxMessage message{.scan_number = static_cast<int>(scan() + 1),
                       .start_ticks = left,
                       .end_ticks = right,
                       .points = {}};
    message.points.assign(kPointsPerMessage, {.angle_ticks = right + 5, .range_cm = 1000});
    return datagram_to(static_cast<std::uint16_t>(100 + sent_ % 3), message.bytes());
  }

  std::uint64_t sent_ = 0;
  Frame stranger_ = datagram_to(kStrangersPort, std::vector<std::byte>(18));
  std::uint64_t flood_from_us_ = 0;
  std::uint64_t flood_per_second_ = 0;
  std::uint64_t flood_sent_ = 0;
};

class Bench {
 public:
  explicit Bench(std::uint64_t datagram_us) : Bench(Costs{.datagram_us = datagram_us}) {}
  explicit Bench(const Costs& costs) : slow_{*target_, platform_, machine_.clock(), costs} {
    machine_.ethernet().arrive(net::testing::linux_arp_reply());
    target_->start(machine_.clock().now_us());
  }

  void run(std::uint64_t duration_us) {
    const std::uint64_t end_us = machine_.clock().now_us() + duration_us;
    while (machine_.clock().now_us() < end_us) {
      traffic.arrive(machine_.clock().now_us(), machine_.ethernet());
      if (!pass(machine_, platform_, *serial_, backlog_, check_, life_, slow_)) {
        machine_.idle();
      }
      machine_.clock().time_us += slow_.costs.pass_us;
      receive();
    }
  }

  [[nodiscard]] Costs& costs() { return slow_.costs; }

  // From the first packet of a frame to its end, the most.
  [[nodiscard]] std::uint64_t longest_us() const {
    std::uint64_t longest_us = 0;
    for (const tests::ReceivedFrame& frame : receiver.frames) {
      if (frame.header.has_evidence()) {
        longest_us = std::max(longest_us, frame.header.closed_us - frame.end.opened_us);
      }
    }
    return longest_us;
  }

  void flood(std::uint64_t per_second) { traffic.flood(machine_.clock().now_us(), per_second); }

  // The machine stands still, and its ring fills.
  void stall(std::uint64_t duration_us) { machine_.clock().time_us += duration_us; }

  [[nodiscard]] std::uint64_t points(Fate fate) const {
    std::uint64_t sum = 0;
    for (const tests::ReceivedFrame& frame : receiver.frames) {
      sum += frame.end.fates[static_cast<std::size_t>(fate)];
    }
    return sum;
  }

  [[nodiscard]] std::uint64_t all_points() const {
    std::uint64_t sum = 0;
    for (const tests::ReceivedFrame& frame : receiver.frames) {
      sum += frame.header.points_used + frame.header.points_other;
    }
    return sum;
  }

  // As the newest frame says it.
  [[nodiscard]] std::uint32_t overflows() const {
    return receiver.frames.back().end.link_counters.at(stream::place_of("port without room"));
  }

  [[nodiscard]] std::size_t timed_out() const {
    return static_cast<std::size_t>(std::ranges::count_if(receiver.frames, [](const auto& frame) {
      return frame.header.has_evidence() && (frame.header.flags & stream::kFlagTimedOut) != 0;
    }));
  }

  Traffic traffic;
  tests::FakePlatform receiver;
  std::uint64_t oldest_scans = 0;  // of a frame's newest sensor, behind what has come

 private:
  void receive() {
    for (const Frame& frame : machine_.ethernet().take_sent()) {
      if (net::testing::be16(frame, 12) != 0x0800) {
        continue;
      }
      const std::size_t before = receiver.frames.size();
      ASSERT_TRUE(receiver.send_message(std::span(frame).subspan(net::testing::kPayloadOffset)));
      if (receiver.frames.size() > before && receiver.frames.back().header.has_evidence()) {
        note_age(receiver.frames.back());
      }
    }
  }

  void note_age(const tests::ReceivedFrame& frame) {
    std::uint32_t newest = 0;
    for (std::size_t i = 0; i < frame.header.sensor_count; ++i) {
      newest = std::max(newest, frame.end.sensors[i].scan_number);
    }
    oldest_scans = std::max(oldest_scans, traffic.scan() + 1 - newest);
  }

  FakeMachine machine_;
  MachinePlatform<FakeMachine> platform_{machine_, kConfig};
  std::unique_ptr<serial::GridSender> serial_ = std::make_unique<serial::GridSender>();
  Backlog backlog_;
  health::MemoryCheck check_{{}};
  Life life_{machine_.clock().now_us()};
  std::unique_ptr<Target> target_ = std::make_unique<Target>(ThreeLux::kVehicle, kConfig.peer.value,
                                                             platform_, Coding::kRaw, *serial_);
  SlowTarget slow_;
};

}  // namespace iog::app::testing
