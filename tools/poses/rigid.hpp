// Poses of a rigid body in space.
#pragma once

#include <array>

namespace iog::tools {

// Three rows of four: a rotation, and behind it the place.
using Rigid = std::array<double, 12>;

// b seen from where a is seen.
[[nodiscard]] Rigid product(const Rigid& a, const Rigid& b);

[[nodiscard]] Rigid inverse(const Rigid& a);

// A body that moves and turns evenly is at `from` at part 0 and at `to` at part 1; others go
// beyond. It turns by less than half a turn.
[[nodiscard]] Rigid between(const Rigid& from, const Rigid& to, double part);

}  // namespace iog::tools
