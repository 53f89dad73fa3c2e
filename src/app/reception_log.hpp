// Records the datagrams that a frame has received and their arrival times, so that a PC can
// reproduce the frame (docs/spec.md 3.13).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "intake/datagram.hpp"
#include "stream/receptions.hpp"

namespace iog::app {

class ReceptionLog {
 public:
  // A disabled log stays empty.
  explicit ReceptionLog(bool is_on) : is_on_(is_on) {}

  [[nodiscard]] bool is_on() const { return is_on_; }

  // Adds a datagram. Call this function when the datagram is processed, and only if the datagram
  // comes from a permitted sender.
  void add(const intake::Datagram& datagram, std::uint64_t now_us) {
    if (!is_on_) {
      return;
    }
    if (count_ == list_.size()) {
      ++not_listed_;
      return;
    }
    // At first, `before_close_us` contains the arrival time modulo 2^32. Later, close() replaces
    // the arrival time with the time from the arrival to the closing of the frame.
    list_[count_++] = {.port = datagram.destination_port,
                       .key = stream::key_of(datagram.payload),
                       .before_close_us = static_cast<std::uint32_t>(now_us)};
  }

  // Records that the latest datagram was shed because it had waited too long.
  void note_left() {
    if (is_on_ && not_listed_ == 0 && count_ > 0) {
      list_[count_ - 1].was_left = true;
    }
  }

  // Call this function once per frame, before the log is read. A frame must be closed less than
  // 2^32 us after its first datagram arrived.
  void close(std::uint64_t closed_us) {
    for (stream::Reception& each : std::span(list_).first(count_)) {
      each.before_close_us = static_cast<std::uint32_t>(closed_us) - each.before_close_us;
    }
  }

  // Returns the received datagrams in order of arrival.
  [[nodiscard]] std::span<const stream::Reception> all() const {
    return std::span(list_).first(count_);
  }
  // Returns the number of datagrams that did not fit into the list.
  [[nodiscard]] std::uint32_t not_listed() const { return not_listed_; }

  void clear() {
    count_ = 0;
    not_listed_ = 0;
  }

 private:
  bool is_on_;
  std::size_t count_ = 0;
  std::uint32_t not_listed_ = 0;
  std::array<stream::Reception, stream::kMaxReceptions> list_{};
};

}  // namespace iog::app
