// What to look at when a receiver has waited and nothing has come.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace iog::tools {

// "nothing came to UDP 127.0.0.1:15000 in 3.0 s, and nothing is written. Does ...". consequence:
// such as ", and nothing is written".
[[nodiscard]] std::string words_of_silence(const std::string& address, std::uint16_t port,
                                           std::chrono::duration<double> waited,
                                           const std::string& consequence = "");

}  // namespace iog::tools
