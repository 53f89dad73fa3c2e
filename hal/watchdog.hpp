// Hardware interface for the watchdog, which resets the machine when the loop stops calling
// service().
#pragma once

#include <concepts>

namespace iog::hal {

template <typename T>
concept Watchdog = requires(T& watchdog) {
  { watchdog.service() } -> std::same_as<void>;
};

}  // namespace iog::hal
