// Hardware interface for the cache that all cores share. Machines that do not need this interface
// omit it.
#pragma once

#include <concepts>

namespace iog::hal {

// After `keep_cache(true)`, newly cached data replaces only a small part of the cache. This mode
// changes run times, but not results. `keep_cache(false)` ends the mode. Initially, the mode is
// off.
template <typename T>
concept SharedCache = requires(T& machine) {
  { machine.keep_cache(true) } -> std::same_as<void>;
};

}  // namespace iog::hal
