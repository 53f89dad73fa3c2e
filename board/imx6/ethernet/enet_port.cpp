// Moving frames. Bringing the controller up, for the first time and again, is in enet_start.cpp.
#include "ethernet/enet_port.hpp"

#include "require/require.hpp"

namespace iog::imx6 {

static_assert(hal::EthernetPort<EnetPort>);

namespace {

using R = EnetRegisters;

constexpr std::size_t kFcsBytes = 4;

// A copy reads whole bursts, of the buffer that holds the frame alone.
static_assert(EnetPort::kFrameBursts * machine::kBurstBytes <= ReceiveRing::kBufferBytes);
static_assert(ReceiveRing::kBufferBytes % machine::kBurstBytes == 0);

}  // namespace

std::span<const std::byte> EnetPort::receive() {
  // Bad frames are dropped until a good one or none is left. A controller that only ever receives
  // bad frames faster than we drop them must not hold the loop: at most one ring of them per call.
  for (std::size_t dropped = 0; frame_.empty() && dropped < EnetMemory::kReceiveFrames; ++dropped) {
    if (!receive_ring_.filled()) {
      break;
    }
    accept();
    give_back();
  }
  return frame_;
}

// Looks at the next filled buffer. If it holds a good frame, its copy is frame_.
void EnetPort::accept() {
  const std::uint16_t flags = receive_ring_.flags();
  const std::size_t bytes = receive_ring_.length();
  const bool last = (flags & receive_flag::kLast) != 0;
  if (in_long_frame_) {
    in_long_frame_ = !last;  // counted at its first buffer
    return;
  }
  if (!last || (flags & (receive_flag::kTooLong | receive_flag::kTruncated)) != 0) {
    in_long_frame_ = !last;
    ++counters_.oversized;
    return;
  }
  constexpr std::uint16_t kBad =
      receive_flag::kNonOctet | receive_flag::kBadCrc | receive_flag::kOverrun;
  // The length of the last buffer is the frame's, with its FCS. It is believed only within the
  // bounds of a frame, whatever the controller wrote.
  if ((flags & kBad) != 0 || bytes < kMinFrameBytes + kFcsBytes ||
      bytes > kMaxFrameBytes + kFcsBytes) {
    ++counters_.receive_errors;
    return;
  }
  ++counters_.received;
  const std::size_t frame_bytes = bytes - kFcsBytes;
  machine::copy_bursts(copy_.data(), receive_ring_.buffer().data(),
                       (frame_bytes + machine::kBurstBytes - 1) / machine::kBurstBytes);
  frame_ = std::span(copy_).first(frame_bytes);
}

// The controller stops looking when it finds no empty buffer; RDAR makes it look again. Also after
// a bad frame: a ring of those would be its last.
void EnetPort::give_back() {
  receive_ring_.recycle();
  cache_.drain_stores();
  registers_.rdar.write(R::kRdarActive);
}

// With no empty buffer, or none in time, frames fill the controller's FIFO, and what comes then is
// lost before anybody sees it (IMX6DQRM, ENET_IEEE_R_MACERR: "Receive FIFO overflow count").
hal::PortCounters EnetPort::counters() const {
  hal::PortCounters counters = counters_;
  counters.receive_overflows += registers_.ieee_r_macerr.read();
  return counters;
}

// It can receive while RDAR is active: the controller clears it when it finds no empty buffer, or
// has been stopped (IMX6DQRM, ENET_RDAR).
hal::PortLife EnetPort::life() const {
  const bool can_receive = (registers_.ecr.read() & R::kEcrEtherEn) != 0 &&
                           (registers_.rdar.read() & R::kRdarActive) != 0;
  const bool nothing_waits = transmit_ring_.in_flight() == 0 && transmit_ring_.queued() == 0;
  return {.moved = counters_.received + counters_.receive_errors + counters_.oversized +
                   transmit_ring_.sent(),
          .is_excused = !link_monitor_.link().up || (can_receive && nothing_waits)};
}

void EnetPort::release() {
  require(!frame_.empty());
  frame_ = {};
}

std::span<std::byte> EnetPort::acquire() {
  if (!acquired_.empty()) {
    return acquired_;
  }
  if (transmit_ring_.full()) {
    transmit_ring_.reclaim();
  }
  if (transmit_ring_.full()) {
    ++counters_.send_refused;
    return {};
  }
  acquired_ = transmit_ring_.buffer();
  return acquired_;
}

std::size_t EnetPort::room() {
  transmit_ring_.reclaim();
  return transmit_ring_.room();
}

void EnetPort::commit(std::size_t frame_bytes) {
  require(!acquired_.empty());
  require(frame_bytes >= kMinFrameBytes && frame_bytes <= kMaxFrameBytes);
  acquired_ = {};
  transmit_ring_.commit(frame_bytes);
  ++counters_.sent;
}

void EnetPort::pump() {
  const std::uint64_t now_us = clock_.now_us();
  link_monitor_.poll(now_us);
  transmit_ring_.reclaim();
  if (must_start_anew(now_us)) {
    start_anew(now_us);
  }
  const std::size_t handed = transmit_ring_.hand_over_queued(shaper_.allowed(now_us));
  shaper_.spend(handed);
  if (handed != 0 || transmit_ring_.in_flight() != 0) {
    kick_transmitter();
  }
}

// Erratum ERR006358: a write to TDAR is lost if it meets the controller clearing it, and ready
// frames would stay. So as long as frames are in flight, every pass looks whether TDAR is still
// set.
void EnetPort::kick_transmitter() {
  cache_.drain_stores();
  if ((registers_.tdar.read() & R::kTdarActive) == 0) {
    registers_.tdar.write(R::kTdarActive);
  }
}

}  // namespace iog::imx6
