#include "text_line.hpp"

namespace iog::board {

TextLine& TextLine::text(std::string_view characters) {
  for (const char character : characters) {
    if (length_ == kCapacity) {
      break;
    }
    characters_[length_++] = character;
  }
  return *this;
}

TextLine& TextLine::hex(std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    octet(static_cast<std::uint8_t>(value >> shift & 0xff));
  }
  return *this;
}

TextLine& TextLine::octet(std::uint8_t value) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  return text(kDigits.substr(value >> 4, 1)).text(kDigits.substr(value & 0xf, 1));
}

TextLine& TextLine::decimal(std::uint32_t value) {
  std::array<char, 10> digits{};  // 2^32 - 1 has ten
  std::size_t first = digits.size();
  do {
    digits[--first] = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  return text({&digits[first], digits.size() - first});
}

}  // namespace iog::board
