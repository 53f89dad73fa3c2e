// What `iog` tells a script: 0 done, 1 a check failed, 2 wrong use or unreadable input.
#pragma once

#include <stdexcept>

namespace iog::tools {

inline constexpr int kDone = 0;
inline constexpr int kCheckFailed = 1;
inline constexpr int kWrongUse = 2;

// Wrong use or unreadable input. The text is one line that says what to do.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The work is done, and its result is not what it has to be.
class CheckFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace iog::tools
