// Visits the constants of a class. Constants are members that are set at start-up and never change
// afterwards, even though they are stored next to data that changes. The memory check treats each
// constant as a region (health/memory_check.hpp).
//
// A class with constants has a member function for_each_constant(visit), which calls visit(bytes)
// for each of its constants, including those of its members.
#pragma once

#include <span>

namespace iog::health {

template <typename Visit, typename... Members>
void visit_constants(Visit&& visit, const Members&... members) {
  (visit(std::as_bytes(std::span(&members, 1))), ...);
}

}  // namespace iog::health
