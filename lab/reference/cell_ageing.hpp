// What time does to a cell of the perception grid, in double precision and by the functions of the
// mathematical library: nothing of it is shared with what it is compared with (Kurdej 2015,
// sections 5.2.3, 6.1, 6.3 and 7.3).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace iog::lab::reference {

// How much of a mass is left depends on how its set lies to the dynamic classes {D, N, M} and to
// the static ones {I, S, U}.
enum class Discounting : std::uint8_t {
  kConservative,  // loses by whatever it meets
  kOptimistic,    // loses by what it is part of
  kClassical,     // all lose like the dynamic classes
  kProportional,  // loses by its share in either, in the limit of small steps
};

// What is left of each mass, and of the accumulator, after some time: 0 ... 1.
struct ReferenceFading {
  double free = 1;
  double occupied = 1;
  double moving = 1;
  double standing = 1;
  double persistence = 1;
};

// Of a group in one frame, from the time since it last had evidence.
struct ReferenceGains {
  double free_mass = 0;       // f of a cell that was crossed
  double persistence = 0;     // d, what the accumulator gains while a cell is occupied
  double decline = 0;         // d_gamma, what it loses while the cell is not
  double specialisation = 0;  // q, the share of the accumulator that specialises
};

// After longer than this nothing is known any more.
inline constexpr double kLongestMemoryMs = 65'535;

// The dynamic classes lose a tenth in 100 ms, the static ones a hundredth.
inline ReferenceFading reference_fading(Discounting discounting, double elapsed_ms) {
  if (elapsed_ms > kLongestMemoryMs) {
    return {0, 0, 0, 0, 0};
  }
  const double dynamic = std::pow(0.9, elapsed_ms / 100);
  const double standing = std::pow(0.99, elapsed_ms / 100);
  switch (discounting) {
    case Discounting::kConservative:
      return {dynamic, dynamic * standing, dynamic, standing, standing};
    case Discounting::kOptimistic:
      return {dynamic, 1, dynamic, standing, standing};
    case Discounting::kProportional:  // one of the four classes of O is dynamic
      return {dynamic, std::pow(dynamic, 0.25) * std::pow(standing, 0.75), dynamic, standing,
              standing};
    case Discounting::kClassical:
      break;
  }
  return {dynamic, dynamic, dynamic, dynamic, dynamic};
}

// A group without any evidence so far is given 100 ms. The thesis's 0.7 for a crossed cell is that
// of a scan of 10 Hz; here it is what crossing for 100 ms adds up to. An object of 3 m that passes
// at 1 m/s fills the accumulator, and gaps of 0.5 m empty it (equations 7.4 and 7.6). A scan of
// 15 Hz specialises by all of the accumulator.
inline ReferenceGains reference_gains(double since_evidence_ms) {
  const double time_ms = std::clamp(since_evidence_ms, 1.0, 100.0);
  return {.free_mass = 1 - std::pow(0.3, time_ms / 100),
          .persistence = time_ms / 3000,
          .decline = 6 * time_ms / 3000,
          .specialisation = std::min(1.0, time_ms * 15 / 1000)};
}

}  // namespace iog::lab::reference
