// A number with so many decimals.
#pragma once

#include <iomanip>
#include <sstream>
#include <string>

namespace iog::tools {

[[nodiscard]] inline std::string fixed(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

}  // namespace iog::tools
