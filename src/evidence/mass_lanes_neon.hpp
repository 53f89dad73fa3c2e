// The masses of a group, eight cells a register, one after the other as they lie in memory.
//
// A load that moves its own pointer is one instruction. The compiler never chooses it: it takes two
// loads of half a register each, at offsets.
#pragma once

#include <arm_neon.h>
#include <cstddef>

#include "evidence/group.hpp"

namespace iog::evidence {

static_assert(offsetof(Group, occupied) == 1 * sizeof(Masses));
static_assert(offsetof(Group, moving) == 2 * sizeof(Masses));
static_assert(offsetof(Group, standing) == 3 * sizeof(Masses));
static_assert(offsetof(Group, persistence) == 4 * sizeof(Masses));
static_assert(offsetof(Group, ruled_out) == 5 * sizeof(Masses));

// Free, occupied, moving, standing and persistence, in this order.
class MassReader {
 public:
  explicit MassReader(const Group& group) : next_(&group.free) {}
  int16x8_t next() {
    int16x8_t lanes;
    asm("vld1.64 {%e[lanes]-%f[lanes]}, [%[next] :128]!"
        : [lanes] "=w"(lanes), [next] "+r"(next_)
        : "m"(*next_));
    return lanes;
  }

 private:
  const Masses* next_;
};

class MassWriter {
 public:
  explicit MassWriter(Group& group) : next_(&group.free) {}
  void put(int16x8_t lanes) {
    asm("vst1.64 {%e[lanes]-%f[lanes]}, [%[next] :128]!"
        : [next] "+r"(next_), "=m"(*next_)
        : [lanes] "w"(lanes));
  }

 private:
  Masses* next_;
};

}  // namespace iog::evidence
