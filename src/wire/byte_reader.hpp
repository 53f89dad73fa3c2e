// Reads wire bytes sequentially and never past the end.
//
// If a read extends beyond the end, it returns 0 or an empty span, and so do all later reads. From
// then on, ok() is false. A decoder can therefore read a complete header and then check ok() once
// before it uses any value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "wire/byte_order.hpp"

namespace iog::wire {

class ByteReader {
  // Clang 14 can evaluate the callers at compile time only if this function is defined before them.
  // Discarding the unread bytes makes the failure permanent without slowing down successful reads.
  constexpr void fail() {
    rest_ = {};
    ok_ = false;
  }

  template <typename Value, std::size_t kBytes>
  constexpr Value take(Value (*load)(std::span<const std::byte, kBytes>)) {
    if (rest_.size() < kBytes) {
      fail();
      return 0;
    }
    const Value value = load(rest_.template first<kBytes>());
    rest_ = rest_.subspan(kBytes);
    return value;
  }

 public:
  constexpr explicit ByteReader(std::span<const std::byte> bytes) : rest_{bytes} {}

  [[nodiscard]] constexpr std::uint8_t u8() { return take(load_u8); }
  [[nodiscard]] constexpr std::uint16_t u16_be() { return take(load_be16); }
  [[nodiscard]] constexpr std::uint16_t u16_le() { return take(load_le16); }
  [[nodiscard]] constexpr std::uint32_t u32_be() { return take(load_be32); }
  [[nodiscard]] constexpr std::uint32_t u32_le() { return take(load_le32); }
  [[nodiscard]] constexpr std::uint64_t u64_be() { return take(load_be64); }
  [[nodiscard]] constexpr std::uint64_t u64_le() { return take(load_le64); }

  // Signed integers use two's complement, as in all wire formats of this project.
  [[nodiscard]] constexpr std::int8_t i8() { return static_cast<std::int8_t>(u8()); }
  [[nodiscard]] constexpr std::int16_t i16_be() { return static_cast<std::int16_t>(u16_be()); }
  [[nodiscard]] constexpr std::int16_t i16_le() { return static_cast<std::int16_t>(u16_le()); }
  [[nodiscard]] constexpr std::int32_t i32_be() { return static_cast<std::int32_t>(u32_be()); }
  [[nodiscard]] constexpr std::int32_t i32_le() { return static_cast<std::int32_t>(u32_le()); }

  // Returns the next `count` bytes as a view of the input, or an empty span if fewer bytes remain.
  [[nodiscard]] constexpr std::span<const std::byte> bytes(std::size_t count) {
    if (count > rest_.size()) {
      fail();
      return {};
    }
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  constexpr void skip(std::size_t count) { static_cast<void>(bytes(count)); }

  // Returns the number of unread bytes, or 0 after a failed read.
  [[nodiscard]] constexpr std::size_t remaining() const { return rest_.size(); }

  // Returns true if no read has failed so far.
  [[nodiscard]] constexpr bool ok() const { return ok_; }

 private:
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

}  // namespace iog::wire
