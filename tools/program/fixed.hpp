// A number with so many decimals.
#pragma once

#include <iomanip>
#include <sstream>
#include <string>

namespace iog::tools {

// "1.50" of 1.5 and 2, and "nan" of no number. `decimals` is 0 or more.
[[nodiscard]] inline std::string fixed(double value, int decimals) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

}  // namespace iog::tools
