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
  // At most this far ahead of the line; 22 ms at 115200 baud, so a pass of the loop may last as
  // long before the line runs dry.
  static constexpr std::uint32_t kBurstBytes = 256;

  // Time has passed. now_us must not go back. bytes_per_second < 2^32 / 1000.
  void advance(std::uint64_t now_us, std::uint32_t bytes_per_second) {
    const std::uint64_t elapsed_us = std::min(now_us - now_us_, kLongUs);
    now_us_ = now_us;
    credit_ = static_cast<std::uint32_t>(
        std::min(credit_ + elapsed_us * bytes_per_second, std::uint64_t{kBurstBytes} * kByte));
  }

  [[nodiscard]] std::size_t bytes() const { return credit_ / kByte; }

  // At most bytes().
  void spend(std::size_t bytes) { credit_ -= static_cast<std::uint32_t>(bytes) * kByte; }

 private:
  static constexpr std::uint32_t kByte = 1'000'000;     // of credit, which is in bytes times us
  static constexpr std::uint64_t kLongUs = 10'000'000;  // after this the credit is full
  static_assert(std::uint64_t{kBurstBytes} * kByte < std::uint64_t{1} << 32);

  std::uint64_t now_us_ = 0;
  std::uint32_t credit_ = 0;
};

}  // namespace iog::serial
