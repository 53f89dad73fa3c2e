// How many bytes a line has time for: what it carries, and no more than a short stretch ahead of
// it.
//
// A port takes more than the line has sent, a whole ring of it; what is in there is old before it
// leaves. So bytes are handed over at the line's own rate. (An emulated line has no rate but this
// one.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace iog::serial {

class LineBudget {
 public:
  // At most so far ahead of the line: a pass of the loop, or several of them that compose the next
  // message, may last as long before the line runs dry.
  static constexpr std::uint32_t kAheadUs = 40'000;

  // What that is in bytes.
  [[nodiscard]] static constexpr std::uint32_t burst_bytes(std::uint32_t bytes_per_second) {
    return static_cast<std::uint32_t>(std::uint64_t{bytes_per_second} * kAheadUs / kByte);
  }

  // Time has passed. now_us must not go back. bytes_per_second < 10^5.
  void advance(std::uint64_t now_us, std::uint32_t bytes_per_second) {
    const auto elapsed_us = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(now_us - now_us_, kAheadUs));  // after this the credit is full
    now_us_ = now_us;
    const std::uint32_t most = kAheadUs * bytes_per_second;
    credit_ += std::min(elapsed_us * bytes_per_second, most - credit_);
  }

  [[nodiscard]] std::size_t bytes() const { return credit_ / kByte; }

  // At most bytes().
  void spend(std::size_t bytes) { credit_ -= static_cast<std::uint32_t>(bytes) * kByte; }

 private:
  static constexpr std::uint32_t kByte = 1'000'000;  // of credit, which is in bytes times us

  std::uint64_t now_us_ = 0;
  std::uint32_t credit_ = 0;
};

}  // namespace iog::serial
