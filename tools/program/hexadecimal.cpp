#include "tools/program/hexadecimal.hpp"

#include <iomanip>
#include <sstream>

namespace iog::tools {

std::string hex(std::uint64_t value, int digits) {
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(digits) << value;
  return text.str();
}

}  // namespace iog::tools
