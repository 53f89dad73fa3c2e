// The functions of Port (port.hpp). Only the file that instantiates Port for a board includes this
// header, so the functions are compiled once.
#pragma once

#include "board/common/ethernet/port.hpp"
#include "require/require.hpp"

namespace iog::board {

// This time is longer than a working controller can keep a frame. At 10 Mbit/s and half duplex, a
// controller backs off from collisions 15 times, for at most 7151 slots of 51.2 us in total (802.3,
// 4.2.3.2.5), and sends 16 times for 1.2 ms each. These steps take 386 ms. At full duplex, sending
// takes 1.2 ms. The loop runs many passes in half a second, and each pass wakes a sleeping
// transmitter.
inline constexpr std::uint64_t kStuckUs = 500'000;
// The shortest time between two restarts because of bus errors.
inline constexpr std::uint64_t kBusErrorPauseUs = 100'000;
// The GEM's smallest statistics counter has 10 bits. At 1 Gbit/s, this counter saturates after 0.7
// ms.
inline constexpr std::uint64_t kStatisticsPeriodUs = 1000;

template <typename Controller>
void Port<Controller>::start(const MacAddress& address) {
  address_ = address;
  set_up(Link{});
  phy_ = controller_.start_phy();
  controller_.run();
}

// A stopped controller forgets its positions in the rings, so both rings start again.
template <typename Controller>
void Port<Controller>::set_up(const Link& mode) {
  mode_ = mode;
  controller_.stop();
  receive_ring_.start();
  transmit_ring_.start();
  controller_.set_up({.address = address_,
                      .groups = groups_,
                      .mode = mode,
                      .receive_ring = receive_ring_.bus_address(),
                      .transmit_ring = transmit_ring_.bus_address()});
}

// The filter may change while frames arrive. A restart sets the filter again.
template <typename Controller>
void Port<Controller>::join(const MacAddress& group) {
  groups_ |= std::uint64_t{1} << Controller::bin_of(group);
  controller_.set_groups(groups_);
}

template <typename Controller>
std::span<const std::byte> Port<Controller>::receive() {
  // This function drops bad frames until it finds a good frame or the ring is empty. Each call
  // drops at most one ring of frames, so that bad frames that arrive faster than they are dropped
  // cannot block the loop.
  for (std::size_t dropped = 0; frame_.empty() && dropped < Format::kReceiveFrames; ++dropped) {
    if (!receive_ring_.filled()) {
      controller_.found_none(receive_ring_.was_full(), counters_);
      break;
    }
    accept();
    receive_ring_.recycle();
    controller_.gave_back(memory_);
  }
  return frame_;
}

// Examines the next filled buffer. If the buffer contains a good frame, the function copies the
// frame, and frame_ refers to the copy.
template <typename Controller>
void Port<Controller>::accept() {
  // The function copies whole bursts, which must not extend beyond the frame's buffer.
  static_assert(kFrameBursts * machine::kBurstBytes <= Format::kReceiveBytes);
  static_assert(Format::kReceiveBytes % machine::kBurstBytes == 0);
  const std::size_t bytes = controller_.frame_bytes(receive_ring_.descriptor(), counters_);
  if (bytes == 0) {
    return;
  }
  ++counters_.received;
  machine::copy_bursts(copy_.data(), receive_ring_.buffer().data(),
                       (bytes + machine::kBurstBytes - 1) / machine::kBurstBytes);
  frame_ = std::span(copy_).first(bytes);
}

template <typename Controller>
hal::PortLife Port<Controller>::life() const {
  const TransmitOrder& order = transmit_ring_.order();
  const bool nothing_waits = order.in_flight() == 0 && order.queued() == 0;
  return {
      .moved = counters_.received + counters_.receive_errors + counters_.oversized + order.sent(),
      .is_excused = !link_monitor_.link().up || (controller_.can_receive() && nothing_waits)};
}

template <typename Controller>
void Port<Controller>::release() {
  require(!frame_.empty());
  frame_ = {};
}

template <typename Controller>
std::span<std::byte> Port<Controller>::acquire() {
  if (!acquired_.empty()) {
    return acquired_;
  }
  if (transmit_ring_.order().room() == 0 && room() == 0) {
    ++counters_.send_refused;
    return {};
  }
  acquired_ = transmit_ring_.buffer();
  return acquired_;
}

template <typename Controller>
std::size_t Port<Controller>::room() {
  transmit_ring_.reclaim();
  return transmit_ring_.order().room();
}

template <typename Controller>
void Port<Controller>::commit(std::size_t frame_bytes) {
  require(!acquired_.empty());
  require(frame_bytes >= kMinFrameBytes && frame_bytes <= kMaxFrameBytes);
  acquired_ = {};
  transmit_ring_.commit(frame_bytes);
  ++counters_.sent;
}

// If the transmitter is woken while it ends its last frame, the wake-up may be lost. Every pass
// therefore wakes the transmitter again while frames are in flight.
template <typename Controller>
void Port<Controller>::pump() {
  const std::uint64_t now_us = clock_.now_us();
  link_monitor_.poll(now_us);
  if (now_us - collected_us_ >= kStatisticsPeriodUs) {
    controller_.collect(counters_);
    collected_us_ = now_us;
  }
  transmit_ring_.reclaim();
  if (must_start_anew(now_us)) {
    start_anew(now_us);
  }
  shaper_.spend(transmit_ring_.hand_over_queued(shaper_.allowed(now_us)));
  if (transmit_ring_.order().in_flight() != 0) {
    memory_.drain_stores();
    controller_.send();
  }
}

// A restart has one of three reasons. After a bus error, the controller has stopped, or the
// position of the controller's DMA is unknown. A frame that never leaves means that the transmitter
// has stopped. A new speed or duplex mode can be set only while the controller is stopped. A link
// that is down keeps its mode.
template <typename Controller>
bool Port<Controller>::must_start_anew(std::uint64_t now_us) {
  const bool stuck = is_stuck(now_us);  // always called, because it keeps track of time
  const Link& link = link_monitor_.link();
  const bool mode_differs =
      link.up && (link.speed != mode_.speed || link.full_duplex != mode_.full_duplex);
  const bool bus_error = controller_.has_bus_error() && now_us - restarted_us_ >= kBusErrorPauseUs;
  return acquired_.empty() && (stuck || mode_differs || bus_error);
}

// Returns true if frames are in flight and no frame has left for kStuckUs. Time without a link does
// not count, because the PHY may have stopped the clock.
template <typename Controller>
bool Port<Controller>::is_stuck(std::uint64_t now_us) {
  const TransmitOrder& order = transmit_ring_.order();
  if (order.in_flight() == 0 || order.sent() != progress_sent_ || !link_monitor_.link().up) {
    progress_sent_ = order.sent();
    progress_us_ = now_us;
  }
  return now_us - progress_us_ >= kStuckUs;
}

// Discards and counts all frames that wait in either ring, because the controller's position in the
// rings is unknown. This function takes about 0.2 ms on the i.MX6, mostly for the descriptors.
template <typename Controller>
void Port<Controller>::start_anew(std::uint64_t now_us) {
  ++counters_.restarts;
  counters_.lost_received += static_cast<std::uint32_t>(receive_ring_.waiting());
  const TransmitOrder& order = transmit_ring_.order();
  counters_.lost_unsent += static_cast<std::uint32_t>(order.queued() + order.in_flight());
  controller_.collect(counters_);
  link_monitor_.abandon();
  const Link& link = link_monitor_.link();
  set_up(link.up ? link : mode_);
  controller_.run();
  restarted_us_ = now_us;
  progress_us_ = now_us;
}

}  // namespace iog::board
