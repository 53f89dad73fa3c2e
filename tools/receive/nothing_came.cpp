#include "tools/receive/nothing_came.hpp"

#include <iomanip>
#include <sstream>

namespace iog::tools {

std::string words_of_silence(const std::string& address, std::uint16_t port,
                             std::chrono::duration<double> waited, const std::string& consequence) {
  std::ostringstream text;
  text << "nothing came to UDP " << address << ':' << port << " in " << std::fixed
       << std::setprecision(1) << waited.count() << " s" << consequence
       << ". Does the target run, and is this the address and port that it sends to?";
  if (address.starts_with("127.")) {
    text << " Only this PC reaches " << address << ": --bind 0.0.0.0 listens to others, too";
  }
  return text.str();
}

}  // namespace iog::tools
