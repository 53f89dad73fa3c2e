// Hardware interface for the cache that all cores share. A machine without such an interface does
// not need it.
#pragma once

#include <concepts>

namespace iog::hal {

// keep_cache(true):   from now on, data that the cache does not have replaces only a small part of
//                     its content. Results do not change, only times.
// keep_cache(false):  ends this. A machine starts this way.
template <typename T>
concept SharedCache = requires(T& machine) {
  { machine.keep_cache(true) } -> std::same_as<void>;
};

}  // namespace iog::hal
