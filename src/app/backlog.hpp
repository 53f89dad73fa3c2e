// Whether the loop keeps up with what comes.
//
// A target that is too slow for its sensors never finds the receive ring empty. What waits there
// grows old, and in the end the controller drops what nobody can count. So what waits is left, and
// counted, as soon as the loop has been busy for as long as the ring holds: the frames that go out
// are of what is fused, and no older.
#pragma once

#include <cstdint>

namespace iog::app {

class Backlog {
 public:
  // The receive ring holds 100 ms of the densest traffic that it is made for. This is less, and two
  // frames of four LUX, so that one late frame leaves nothing.
  static constexpr std::uint64_t kLongestUs = 80'000;

  // A pass of the loop begins. What came while the loop slept, or was not run, has not waited for
  // it.
  void begin_pass(std::uint64_t now_us) {
    if (!is_busy_) {
      is_busy_ = true;
      since_us_ = now_us;
    }
  }

  // The ring was found empty, or what was in it has been left.
  void clear() { is_busy_ = false; }

  [[nodiscard]] bool is_too_long(std::uint64_t now_us) const {
    return is_busy_ && now_us - since_us_ >= kLongestUs;
  }

 private:
  bool is_busy_ = false;
  std::uint64_t since_us_ = 0;
};

}  // namespace iog::app
