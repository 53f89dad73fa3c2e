// What is set when the program starts and never again, among what changes: a region of the check of
// memory (health/memory_check.hpp) each.
//
// A class that has such members has for_each_constant(visit), which calls visit(bytes) for them and
// for those of its parts.
#pragma once

#include <cstddef>
#include <span>

namespace iog::health {

template <typename Visit, typename... Members>
void visit_constants(Visit&& visit, const Members&... members) {
  (visit(std::as_bytes(std::span(&members, 1))), ...);
}

}  // namespace iog::health
