// A line of text of bounded length that needs no C library. Text that does not fit is cut off.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::board {

class TextLine {
 public:
  TextLine& text(std::string_view characters);
  TextLine& hex(std::uint32_t value);      // eight digits, no prefix
  TextLine& octet(std::uint8_t value);     // two digits
  TextLine& decimal(std::uint32_t value);  // no leading zeros

  std::string_view view() const { return {characters_.data(), length_}; }

 private:
  static constexpr std::size_t kCapacity = 240;
  std::array<char, kCapacity> characters_{};
  std::size_t length_ = 0;
};

}  // namespace iog::board
