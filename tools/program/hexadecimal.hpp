// Numbers in hexadecimal digits.
#pragma once

#include <cstdint>
#include <string>

namespace iog::tools {

// "00c0ffee", at least so many digits.
[[nodiscard]] std::string hex(std::uint64_t value, int digits = 8);

}  // namespace iog::tools
