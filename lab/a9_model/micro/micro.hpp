// Programs with known answers: each is a region of its own for the model (marker.hpp) and says how
// many units its cycles are to be divided by.
#pragma once

#include <cstdint>
#include <cstdio>

#include "lab/a9_model/marker.hpp"

namespace iog::a9_model::micro {

// A program returns the number of its units.
using Program = std::uint32_t (*)();

// Calls it, always by one and the same copy of its code.
std::uint32_t run(Program program);

// Runs a program once to warm caches and predictors, then in region kId, and prints its line.
template <unsigned kId>
void measure(const char* name, Program program) {
  run(program);
  begin_region<kId>();
  const std::uint32_t units = run(program);
  end_region<kId>();
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf("micro region=%llu name=%s units=%llu\n", std::uint64_t{kId}, name,
              std::uint64_t{units});
}

// Regions 0 to 39, 40 to 79, 80 to 99 and 100 to 119.
void measure_core();
void measure_memory();
void measure_branches();
void measure_vectors();

}  // namespace iog::a9_model::micro
