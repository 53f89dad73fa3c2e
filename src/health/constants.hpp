// Members that are set at start-up and then never change, although they lie between data that
// changes. Each is a region of the memory check (health/memory_check.hpp).
//
// A class with such members has for_each_constant(visit). It calls visit(bytes) for each constant,
// including the constants of its members.
#pragma once

#include <span>

namespace iog::health {

template <typename Visit, typename... Members>
void visit_constants(Visit&& visit, const Members&... members) {
  (visit(std::as_bytes(std::span(&members, 1))), ...);
}

}  // namespace iog::health
