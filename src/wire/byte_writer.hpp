// Writes wire bytes sequentially and never past the end of the buffer.
//
// If a write does not fit, it has no effect, and neither do later writes, even shorter ones. From
// then on, ok() is false. An encoder can therefore write a complete message and then check ok()
// once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "wire/byte_order.hpp"

namespace iog::wire {

class ByteWriter {
  // Clang 14 can evaluate the callers at compile time only if this function is defined before them.
  // Setting the end of the buffer here makes the failure permanent without slowing down successful
  // writes.
  constexpr void fail() {
    buffer_ = written();
    ok_ = false;
  }

  constexpr std::span<std::byte> claim(std::size_t count) {
    if (count > remaining()) {
      fail();
      return {};
    }
    const auto claimed = buffer_.subspan(position_, count);
    position_ += count;
    return claimed;
  }

  template <typename Value, std::size_t kBytes>
  constexpr void put(void (*store)(std::span<std::byte, kBytes>, Value),
                     std::type_identity_t<Value> value) {
    if (remaining() < kBytes) {
      fail();
      return;
    }
    store(buffer_.subspan(position_).template first<kBytes>(), value);
    position_ += kBytes;
  }

 public:
  constexpr explicit ByteWriter(std::span<std::byte> buffer) : buffer_{buffer} {}

  constexpr void u8(std::uint8_t value) { put(store_u8, value); }
  constexpr void u16_be(std::uint16_t value) { put(store_be16, value); }
  constexpr void u16_le(std::uint16_t value) { put(store_le16, value); }
  constexpr void u32_be(std::uint32_t value) { put(store_be32, value); }
  constexpr void u32_le(std::uint32_t value) { put(store_le32, value); }
  constexpr void u64_be(std::uint64_t value) { put(store_be64, value); }
  constexpr void u64_le(std::uint64_t value) { put(store_le64, value); }

  // Signed integers use two's complement, as in all wire formats of this project.
  constexpr void i8(std::int8_t value) { u8(static_cast<std::uint8_t>(value)); }
  constexpr void i16_be(std::int16_t value) { u16_be(static_cast<std::uint16_t>(value)); }
  constexpr void i16_le(std::int16_t value) { u16_le(static_cast<std::uint16_t>(value)); }
  constexpr void i32_be(std::int32_t value) { u32_be(static_cast<std::uint32_t>(value)); }
  constexpr void i32_le(std::int32_t value) { u32_le(static_cast<std::uint32_t>(value)); }

  // Writes all of `source` or nothing. `source` must not overlap the buffer.
  constexpr void bytes(std::span<const std::byte> source) {
    const auto target = claim(source.size());
    for (std::size_t i = 0; i < target.size(); ++i) {
      target[i] = source[i];
    }
  }

  // Writes `count` zero bytes, for reserved fields and padding.
  constexpr void zeros(std::size_t count) {
    for (std::byte& target : claim(count)) {
      target = std::byte{0};
    }
  }

  // Skips `count` bytes without writing, for a field that is filled in later.
  constexpr void skip(std::size_t count) { static_cast<void>(claim(count)); }

  // Returns the bytes written so far, including skipped bytes.
  [[nodiscard]] constexpr std::span<std::byte> written() const { return buffer_.first(position_); }

  // Returns the number of free bytes, or 0 after a failed write.
  [[nodiscard]] constexpr std::size_t remaining() const { return buffer_.size() - position_; }

  // Returns true if no write has failed so far.
  [[nodiscard]] constexpr bool ok() const { return ok_; }

 private:
  std::span<std::byte> buffer_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

}  // namespace iog::wire
