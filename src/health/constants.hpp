// Members that are set at start and never again, beside data that changes. Each is a region of the
// check of memory (health/memory_check.hpp).
//
// A class with such members has for_each_constant(visit), which calls visit(bytes) for them and for
// those of its parts.
#pragma once

#include <cstddef>
#include <span>

namespace iog::health {

template <typename Visit, typename... Members>
void visit_constants(Visit&& visit, const Members&... members) {
  (visit(std::as_bytes(std::span(&members, 1))), ...);
}

}  // namespace iog::health
