// Reads and writes all masses of a group except F, in memory order. Each register holds eight
// cells.
//
// A single instruction can load a register and advance the pointer, but the compiler never emits
// it. Instead, the compiler emits two half-register loads with offsets.
#pragma once

#include <arm_neon.h>
#include <cstddef>

#include "evidence/group.hpp"
#include "lanes/moves_neon.hpp"

namespace iog::evidence {

static_assert(offsetof(Taken, occupied) == 0 * sizeof(Masses));
static_assert(offsetof(Taken, moving) == 1 * sizeof(Masses));
static_assert(offsetof(Taken, standing) == 2 * sizeof(Masses));
static_assert(offsetof(Taken, persistence) == 3 * sizeof(Masses));
static_assert(sizeof(Taken) == 4 * sizeof(Masses));

inline int16x8_t load(const Masses& masses) {
  int16x8_t lanes;
  __builtin_memcpy(&lanes, __builtin_assume_aligned(masses.data(), sizeof(lanes)), sizeof(lanes));
  return lanes;
}

inline void store(int16x8_t lanes, Masses& masses) {
  __builtin_memcpy(__builtin_assume_aligned(masses.data(), sizeof(lanes)), &lanes, sizeof(lanes));
}

// Reads the occupied, moving, standing and persistence values, in this order.
class MassReader {
 public:
  explicit MassReader(const Taken& taken) : next_(&taken.occupied) {}
  int16x8_t next() { return lanes::load_next(next_); }

 private:
  const Masses* next_;
};

class MassWriter {
 public:
  explicit MassWriter(Taken& taken) : next_(&taken.occupied) {}
  void put(int16x8_t masses) { lanes::store_next(masses, next_); }

 private:
  Masses* next_;
};

}  // namespace iog::evidence
