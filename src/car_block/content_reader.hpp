// Reads what vehicle/content.hpp writes. What cannot be read makes ok() false for good, and what is
// read afterwards is of no meaning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "wire/byte_reader.hpp"

namespace iog::car_block {

class ContentReader {
 public:
  // Texts are views of the bytes.
  explicit ContentReader(std::span<const std::byte> bytes) : in_(bytes) {}

  [[nodiscard]] std::uint8_t u8() { return in_.u8(); }
  [[nodiscard]] std::uint16_t u16() { return in_.u16_be(); }
  [[nodiscard]] std::uint32_t u32() { return in_.u32_be(); }
  [[nodiscard]] std::int8_t i8() { return in_.i8(); }
  [[nodiscard]] std::int16_t i16() { return in_.i16_be(); }
  [[nodiscard]] std::int32_t i32() { return in_.i32_be(); }
  [[nodiscard]] std::int64_t i64() { return static_cast<std::int64_t>(in_.u64_be()); }

  [[nodiscard]] bool truth() { return below(2) != 0; }

  // A byte below count.
  [[nodiscard]] std::uint8_t below(std::uint8_t count) {
    const std::uint8_t value = in_.u8();
    demand(value < count);
    return value;
  }

  template <typename Enum>
  [[nodiscard]] Enum word(std::uint8_t count) {
    return static_cast<Enum>(below(count));
  }

  // Letters up to a 0, which must be there.
  [[nodiscard]] std::string_view text() {
    wire::ByteReader ahead = in_;
    std::size_t length = 0;
    while (ahead.u8() != 0) {
      ++length;
    }
    const std::span<const std::byte> letters = in_.bytes(length);
    in_.skip(1);
    return {reinterpret_cast<const char*>(letters.data()), letters.size()};
  }

  void demand(bool holds) { holds_ = holds_ && holds; }
  [[nodiscard]] bool ok() const { return holds_ && in_.ok(); }
  [[nodiscard]] bool is_at_end() const { return in_.remaining() == 0; }

 private:
  wire::ByteReader in_;
  bool holds_ = true;
};

}  // namespace iog::car_block
