// A cell of the perception grid in real numbers, as Kurdej 2015 has it (chapters 5 and 6), with
// what iogrid fixes where the thesis leaves a choice open: what evidence weighs by time, that
// ignorance is not specialised, and that an aged accumulator decays like what stands.
#pragma once

#include <algorithm>
#include <cmath>

namespace iog::tests {

struct ExactCell {
  double free = 0;
  double occupied = 0;
  double moving = 0;
  double standing = 0;
  double persistence = 0;

  [[nodiscard]] double taken() const { return occupied + moving + standing; }
  [[nodiscard]] double ignorance() const { return 1 - free - taken(); }
};

// What is left after some milliseconds.
inline double exact_dynamic(double ms) { return std::pow(0.90, ms / 100); }
inline double exact_static(double ms) { return std::pow(0.99, ms / 100); }

// The mass of free that crossing beams give in some milliseconds.
inline double exact_free_mass(double ms) { return 1 - std::pow(0.3, ms / 100); }

// occupied: what is left of {I, M, S, U}.
inline void age_exactly(ExactCell& cell, double dynamic, double occupied, double fixed) {
  cell.free *= dynamic;
  cell.occupied *= occupied;
  cell.moving *= dynamic;
  cell.standing *= fixed;
  cell.persistence *= fixed;
}

// o, f: evidence for occupied and for free; ms: since the last evidence, 1 ... 100.
inline void fuse_exactly(ExactCell& cell, double o, double f, bool moved, double ms) {
  const double appeared = cell.free * o;
  const double disappeared = cell.taken() * f;
  const double ignorance = cell.ignorance();
  cell.free = cell.free * (1 - o) + ignorance * f;
  cell.occupied = cell.occupied * (1 - f) + ignorance * o + (moved ? 0 : appeared);
  cell.moving = cell.moving * (1 - f) + (moved ? appeared : 0);
  cell.standing *= 1 - f;

  const double gain = cell.taken() * (1 - appeared - disappeared) * ms / 3000;
  const double loss = (1 - cell.taken()) * 6 * ms / 3000;
  cell.persistence = std::clamp(cell.persistence + gain - loss, 0.0, 1.0);

  const double part = cell.persistence * std::min(1.0, ms * 15 / 1000);
  cell.standing += cell.occupied * part;
  cell.occupied -= cell.occupied * part;
  cell.moving *= 1 - part;
}

}  // namespace iog::tests
