// An Ethernet port in memory for tests. It keeps the seam's rules strictly: every frame lives in
// its own heap block of exactly its length, gone after release(), so that the address sanitizer
// sees a byte read too far or too late; and it counts what its user does against them.
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "hal/ethernet_port.hpp"

namespace iog::fakes {

class FakeEthernetPort {
 public:
  using Frame = std::vector<std::byte>;

  static constexpr std::size_t kMinCommitBytes = 14;
  static constexpr std::size_t kMaxFrameBytes = 1514;

  // --- the seam -------------------------------------------------------------------------------

  std::span<const std::byte> receive() {
    if (arrived_.empty()) {
      return {};
    }
    if (!received_) {
      received_ = true;
      ++counters_.received;
    }
    return arrived_.front();
  }

  void release() {
    if (!received_) {
      ++violations_;
      return;
    }
    received_ = false;
    arrived_.pop_front();
  }

  std::span<std::byte> acquire() {
    if (!acquired_ && queued_ >= ring_slots_) {
      ++counters_.send_refused;
      return {};
    }
    if (!acquired_) {
      // What a used buffer holds is anything but zero.
      buffer_.assign(kMaxFrameBytes, std::byte{0xEE});
      acquired_ = true;
    }
    return buffer_;
  }

  [[nodiscard]] std::size_t room() const {
    return ring_slots_ > queued_ ? ring_slots_ - queued_ : 0;
  }

  void commit(std::size_t frame_bytes) {
    if (!acquired_ || frame_bytes < kMinCommitBytes || frame_bytes > kMaxFrameBytes) {
      ++violations_;
      return;
    }
    buffer_.resize(frame_bytes);
    sent_.push_back(std::move(buffer_));
    acquired_ = false;
    ++queued_;
    ++counters_.sent;
  }

  void pump() { queued_ = 0; }

  [[nodiscard]] hal::PortCounters counters() const { return counters_; }
  [[nodiscard]] hal::PortLife life() const {
    return {.moved = counters_.received + counters_.sent, .is_excused = is_excused_};
  }

  // --- the test's side ------------------------------------------------------------------------

  void arrive(Frame frame) { arrived_.push_back(std::move(frame)); }

  // A frame for which there is no room.
  void overflow() { ++counters_.receive_overflows; }

  // As a driver does whose controller has stopped.
  void start_anew(std::uint32_t lost_received, std::uint32_t lost_unsent) {
    ++counters_.restarts;
    counters_.lost_received += lost_received;
    counters_.lost_unsent += lost_unsent;
  }

  // Whether it has a reason to be silent.
  void excuse(bool is_excused) { is_excused_ = is_excused; }

  // Frames that can be committed before pump() makes room again.
  void set_ring_slots(std::size_t slots) { ring_slots_ = slots; }

  // The frames committed since the last call.
  [[nodiscard]] std::vector<Frame> take_sent() { return std::exchange(sent_, {}); }

  // Arrived frames that have not been released.
  [[nodiscard]] std::size_t waiting() const { return arrived_.size(); }

  // Calls against the rules of hal::EthernetPort.
  [[nodiscard]] int violations() const { return violations_; }

 private:
  std::deque<Frame> arrived_;
  std::vector<Frame> sent_;
  Frame buffer_;
  hal::PortCounters counters_;
  std::size_t ring_slots_ = 64;
  std::size_t queued_ = 0;
  int violations_ = 0;
  bool received_ = false;
  bool is_excused_ = true;
  bool acquired_ = false;
};

static_assert(hal::EthernetPort<FakeEthernetPort>);

}  // namespace iog::fakes
