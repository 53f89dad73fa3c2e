#include "text_line.hpp"

namespace iog::imx6 {

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
  constexpr std::string_view kDigits = "0123456789abcdef";
  for (int shift = 28; shift >= 0; shift -= 4) {
    text(kDigits.substr((value >> shift) & 0xf, 1));
  }
  return *this;
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

}  // namespace iog::imx6
