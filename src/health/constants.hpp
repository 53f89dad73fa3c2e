// Visits the constants of a class. Constants are members that are set at start-up and then never
// change, although they lie between changing data. Each constant is a region of the memory check
// (health/memory_check.hpp).
//
// A class with constants has a member function for_each_constant(visit), which calls visit(bytes)
// for each constant, including the constants of the class's members.
#pragma once

#include <span>

namespace iog::health {

template <typename Visit, typename... Members>
void visit_constants(Visit&& visit, const Members&... members) {
  (visit(std::as_bytes(std::span(&members, 1))), ...);
}

}  // namespace iog::health
