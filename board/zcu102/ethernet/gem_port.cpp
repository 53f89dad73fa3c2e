// Moving frames. Bringing the controller up, for the first time and again, is in gem_start.cpp.
#include "ethernet/gem_port.hpp"

#include "require/require.hpp"

namespace iog::zcu102 {

static_assert(hal::EthernetPort<GemPort>);

namespace {

using R = GemRegisters;

// The smallest statistic has 10 bits; a gigabit wire fills it in 0.7 ms, and then it stays full.
constexpr std::uint64_t kStatisticsPeriodUs = 1000;

// A copy reads whole bursts, of the buffer that holds the frame alone.
static_assert(GemPort::kFrameBursts * machine::kBurstBytes <= ReceiveRing::kBufferBytes);
static_assert(ReceiveRing::kBufferBytes % machine::kBurstBytes == 0);

}  // namespace

std::span<const std::byte> GemPort::receive() {
  // Bad frames are dropped until a good one or none is left, at most one ring of them per call.
  for (std::size_t dropped = 0; frame_.empty() && dropped < GemMemory::kReceiveFrames; ++dropped) {
    if (!receive_ring_.filled()) {
      look_again();
      break;
    }
    accept();
    receive_ring_.recycle();
  }
  return frame_;
}

// Looks at the next filled buffer. If it holds a good frame, its copy is frame_. The controller
// drops frames with a wrong FCS and longer than 1518 bytes, and its statistics count them.
void GemPort::accept() {
  const std::uint32_t control = receive_ring_.control();
  const bool first = (control & receive_flag::kFirst) != 0;
  if (!first || (control & receive_flag::kLast) == 0) {
    counters_.oversized += first ? 1 : 0;  // a frame of several buffers, once
    return;
  }
  // The length is without FCS, and is believed only within the bounds of a frame.
  const std::size_t bytes = control & receive_flag::kLength;
  if (bytes < kMinFrameBytes || bytes > kMaxFrameBytes) {
    ++counters_.receive_errors;
    return;
  }
  ++counters_.received;
  machine::copy_bursts(copy_.data(), receive_ring_.buffer().data(),
                       (bytes + machine::kBurstBytes - 1) / machine::kBurstBytes);
  frame_ = std::span(copy_).first(bytes);
}

// Once the ring was full, QEMU's GEM keeps the descriptor that it found used, until NETWORK_CONTROL
// is written. That write delivers as many waiting frames as there are free buffers and drops the
// others, so it comes only when all buffers are free. The GEM itself looks again with each frame,
// and the write changes nothing. At least one frame was lost, also if no statistic says so.
void GemPort::look_again() {
  if ((registers_.receive_status.read() & R::kReceiveNoBuffer) == 0) {
    return;
  }
  registers_.receive_status.clear(R::kReceiveNoBuffer);
  collect_statistics();
  counters_.receive_overflows += counters_.receive_overflows == overflows_seen_ ? 1 : 0;
  overflows_seen_ = counters_.receive_overflows;
  machine::barrier();
  registers_.network_control.write(registers_.network_control.read());
}

// Reading a statistic clears it. QEMU's do not clear, but never count any of these.
void GemPort::collect_statistics() {
  counters_.receive_errors += registers_.undersize_frames.read() + registers_.fcs_errors.read() +
                              registers_.rx_length_errors.read() +
                              registers_.rx_symbol_errors.read() +
                              registers_.alignment_errors.read();
  counters_.oversized += registers_.excessive_rx_length.read() + registers_.rx_jabbers.read();
  counters_.receive_overflows +=
      registers_.rx_resource_errors.read() + registers_.rx_overruns.read();
}

hal::PortLife GemPort::life() const {
  const bool can_receive = (registers_.network_control.read() & R::kControlReceive) != 0 &&
                           (registers_.receive_status.read() & R::kReceiveNoBuffer) == 0;
  const TransmitOrder& order = transmit_ring_.order();
  const bool nothing_waits = order.in_flight() == 0 && order.queued() == 0;
  return {
      .moved = counters_.received + counters_.receive_errors + counters_.oversized + order.sent(),
      .is_excused = !link_monitor_.link().up || (can_receive && nothing_waits)};
}

void GemPort::release() {
  require(!frame_.empty());
  frame_ = {};
}

std::span<std::byte> GemPort::acquire() {
  if (!acquired_.empty()) {
    return acquired_;
  }
  if (transmit_ring_.order().room() == 0) {
    transmit_ring_.reclaim();
  }
  if (transmit_ring_.order().room() == 0) {
    ++counters_.send_refused;
    return {};
  }
  acquired_ = transmit_ring_.buffer();
  return acquired_;
}

std::size_t GemPort::room() {
  transmit_ring_.reclaim();
  return transmit_ring_.order().room();
}

void GemPort::commit(std::size_t frame_bytes) {
  require(!acquired_.empty());
  require(frame_bytes >= kMinFrameBytes && frame_bytes <= kMaxFrameBytes);
  acquired_ = {};
  transmit_ring_.commit(frame_bytes);
  ++counters_.sent;
}

// A start that meets the transmitter ending its last frame may be lost, so as long as frames are in
// flight, every pass starts it again; while it sends, a start changes nothing.
void GemPort::pump() {
  const std::uint64_t now_us = now_us_();
  link_monitor_.poll(now_us);
  if (now_us - collected_us_ >= kStatisticsPeriodUs) {
    collect_statistics();
    collected_us_ = now_us;
  }
  transmit_ring_.reclaim();
  if (must_start_anew(now_us)) {
    start_anew(now_us);
  }
  shaper_.spend(transmit_ring_.hand_over_queued(shaper_.allowed(now_us)));
  if (transmit_ring_.order().in_flight() != 0) {
    machine::barrier();
    registers_.network_control.set_bits(R::kControlStartTransmit);
  }
}

// UG1087 says that a one clears, QEMU's clear when they are read.
void GemPort::clear_event() { registers_.int_status.clear(registers_.int_status.read()); }

}  // namespace iog::zcu102
