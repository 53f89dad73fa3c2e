// Hardware interface for the cache that all cores share. Machines that do not need it omit it.
#pragma once

#include <concepts>

namespace iog::hal {

// keep_cache(true):   from now on, newly cached data replaces only a small part of the cache. This
//                     changes only run times, not results.
// keep_cache(false):  ends this. This is the initial state.
template <typename T>
concept SharedCache = requires(T& machine) {
  { machine.keep_cache(true) } -> std::same_as<void>;
};

}  // namespace iog::hal
