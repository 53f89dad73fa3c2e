// One cell of the perception grid in double precision, after Kurdej 2015: a reference for the
// integers of src/evidence and src/decision, written for reading. The tests of lab/reference show
// that it is the thesis's cell over all 64 sets where the two mean the same. It is not in
// lab/reference because the Cortex-A9 and the sanitizers test without the laboratory.
//
// A mass is 0 ... 1, and what the four masses leave of 1 is ignorance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fakes/group.hpp"
#include "fakes/reference_ageing.hpp"

namespace iog::tests {

// How an index becomes evidence. Each says what a cell that was hit is worth; all but the last two
// take what a crossed cell is worth from the time, ReferenceGains::free_mass.
enum class EvidenceRule : std::uint8_t {
  kByTime,        // a hit 111/128, which outlives one frame in which the cell is crossed
  kReinforced,    // 1 - 0.2^k for k echoes (Kurdej 2015, section 4.5.2.2), an echo being +2
  kIsopignistic,  // the least committed evidence whose pignistic probability is that of the index
  kThesis,        // a hit 0.8, a crossed cell 0.7, however long ago the last frame was
};

// Masses of free and of occupied, of which one is 0. Both 0: no evidence.
struct ReferenceEvidence {
  double free = 0;
  double occupied = 0;
};

// The largest multiple of 1/128 that is not above a mass, at most 127/128.
inline double in_128ths(double mass) { return std::min(127.0, std::floor(128 * mass)) / 128; }

// index: of the cell in this frame, joined over its slices, -127 ... 127. One echo is +2.
inline ReferenceEvidence reference_evidence(int index, const ReferenceGains& gains,
                                            EvidenceRule rule) {
  if (index == 0) {
    return {};
  }
  if (rule == EvidenceRule::kIsopignistic) {
    const double probability = 1 / (1 + std::pow(0.45 / 0.55, index));
    const double mass = in_128ths(std::min(std::abs(2 * probability - 1), 0.95));
    return index < 0 ? ReferenceEvidence{mass, 0} : ReferenceEvidence{0, mass};
  }
  if (index < 0) {
    return {.free = rule == EvidenceRule::kThesis ? 0.7 : gains.free_mass};
  }
  if (rule == EvidenceRule::kReinforced) {
    return {.occupied = in_128ths(1 - std::pow(0.2, std::ceil(index / 2.0)))};
  }
  return {.occupied = rule == EvidenceRule::kThesis ? 0.8 : 111.0 / 128};
}

struct ReferenceCell {
  double free = 0;         // F = {D, N}
  double occupied = 0;     // O = {I, M, S, U}
  double moving = 0;       // M = {M}
  double standing = 0;     // K = {I, S, U}
  double persistence = 0;  // the accumulator zeta, no mass

  [[nodiscard]] double taken() const { return occupied + moving + standing; }
  [[nodiscard]] double ignorance() const { return 1 - free - taken(); }

  void age(const ReferenceFading& left) {
    free *= left.free;
    occupied *= left.occupied;
    moving *= left.moving;
    standing *= left.standing;
    persistence *= left.persistence;
  }

  // One frame's evidence, after ageing. `moved` says where the conflict of a cell that was free and
  // is hit goes to: to what moves, else to what is occupied. The conflict of a cell that was
  // occupied and is crossed goes to ignorance. Without evidence nothing changes.
  void fuse(const ReferenceEvidence& evidence, bool moved, const ReferenceGains& gains) {
    if (evidence.free == 0 && evidence.occupied == 0) {
      return;
    }
    const double appeared = free * evidence.occupied;
    const double disappeared = taken() * evidence.free;
    const double unknown = ignorance();
    free = free * (1 - evidence.occupied) + unknown * evidence.free;
    occupied = occupied * (1 - evidence.free) + unknown * evidence.occupied;
    moving *= 1 - evidence.free;
    standing *= 1 - evidence.free;
    (moved ? moving : occupied) += appeared;
    accumulate(1 - appeared - disappeared, gains);
    specialise(gains);
  }

 private:
  void accumulate(double agreement, const ReferenceGains& gains) {
    const double risen = taken() * agreement * gains.persistence;
    const double fallen = (1 - taken()) * gains.decline;
    persistence = std::clamp(persistence + risen - fallen, 0.0, 1.0);
  }

  // Occupied sets alone: ignorance stays ignorance. What {M} loses has no set to go to.
  void specialise(const ReferenceGains& gains) {
    const double share = persistence * gains.specialisation;
    standing += occupied * share;
    occupied *= 1 - share;
    moving *= 1 - share;
  }
};

// The cell that eight integer ones hold at `cell`.
inline ReferenceCell reference_cell(const evidence::Group& group, std::size_t cell) {
  const auto mass = [&](const evidence::Masses& masses) {
    return masses[cell] / double{evidence::kCertain};
  };
  return {.free = mass(group.free),
          .occupied = mass(group.occupied),
          .moving = mass(group.moving),
          .standing = mass(group.standing),
          .persistence = mass(group.persistence)};
}

// The largest difference between the masses of two cells, ignorance included. The accumulator is
// not in it.
inline double mass_difference(const ReferenceCell& one, const ReferenceCell& other) {
  const std::array differences{one.free - other.free, one.occupied - other.occupied,
                               one.moving - other.moving, one.standing - other.standing,
                               one.ignorance() - other.ignorance()};
  double largest = 0;
  for (const double difference : differences) {
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

}  // namespace iog::tests
