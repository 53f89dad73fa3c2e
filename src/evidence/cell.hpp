// Ages and fuses one cell (Kurdej 2015, chapters 5 and 6). This file specifies the result in plain
// integer arithmetic. `fusion_neon.cpp` computes the same results for eight cells at once.
//
// All values are in units of 2^-15. `a.b` is floor(a * b / 2^15), and `~a` is 32767 - a. `o` and
// `f` denote evidence, and `c` and `x` denote conflict. F, O, M and K are masses. P is O + M + K,
// and the ignorance W is 32767 - F - P.
//
// A cell is valid if F, O, M, K and the persistence are in the range 0 ... 32767 and W >= 0.
// Factors and evidence are in the range 0 ... 32767, and at least one of o and f is 0. Under these
// conditions, the following bounds hold:
//
//   products     ab <= 32767^2 < 2^30, and a.b <= a because b < 2^15; the rounded product is at
//                most (32767^2 + 2^14) / 2^15 < 32767
//   ageing       no mass grows, so W >= 0 still holds
//   a hit        f = x = 0, so F' + c = F.~o + F.o <= F and O' + M' + K' <= P + W.o + c; the sum
//                of all is at most F + P + W = 32767
//   free         o = c = 0, so F' <= F + W.f and O' + M' + K' <= P.~f <= P; the same bound holds
//   conflict     c + x <= 32767, because one of them is 0
//   persistence  gain and decline are 0 ... 32767 each, and the result is clamped
//   specialising t <= O', which K' gains and O' loses; M' only shrinks
// All terms of F', O', M' and K' are non-negative, so no partial sum exceeds 32767. Every
// intermediate result except a product fits into a signed 16-bit integer. Rounding losses are added
// to ignorance.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "evidence/assignment.hpp"
#include "evidence/factors.hpp"
#include "evidence/group.hpp"

namespace iog::evidence {

struct Cell {
  std::int32_t free = 0;         // F
  std::int32_t occupied = 0;     // O
  std::int32_t moving = 0;       // M
  std::int32_t standing = 0;     // K
  std::int32_t persistence = 0;  // the accumulator zeta

  // Returns the total occupied mass P.
  [[nodiscard]] constexpr std::int32_t taken() const { return occupied + moving + standing; }
  friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

// The masses that one frame assigns to a cell. At least one of the two masses is 0.
struct Evidence {
  std::int32_t occupied = 0;  // o
  std::int32_t free = 0;      // f
};

constexpr std::int32_t product(std::int32_t a, std::int32_t b) { return (a * b) >> 15; }

// Returns the product, rounded to the nearest integer. Ties are rounded up.
constexpr std::int32_t rounded_product(std::int32_t a, std::int32_t b) {
  return (a * b + (1 << 14)) >> 15;
}

constexpr std::int32_t complement(std::int32_t a) { return kCertain - a; }

constexpr std::int32_t left_of(std::int32_t mass, std::int16_t factor) {
  return factor == kWhole ? mass : product(mass, factor);
}

constexpr Cell aged(const Cell& cell, const Fading& fading) {
  return {left_of(cell.free, fading.free), left_of(cell.occupied, fading.occupied),
          left_of(cell.moving, fading.moving), left_of(cell.standing, fading.standing),
          left_of(cell.persistence, fading.persistence)};
}

constexpr Evidence evidence_of(index::OccupancyIndex index, const Gains& gains) {
  return {.occupied = index > 0 ? gains.hit_mass : 0, .free = index < 0 ? gains.free_mass : 0};
}

// `index` must be in the range -127 ... 127.
constexpr Evidence evidence_of(index::OccupancyIndex index, const Gains& gains,
                               const Assignment& assignment) {
  constexpr int kUnit = (kCertain + 1) / kMassFraction;
  const auto graded = static_cast<std::size_t>(
      std::min(index < 0 ? -index : index, static_cast<int>(kGradedIndexes) - 1));
  if (index > 0) {
    return {.occupied = assignment.occupied[graded] * kUnit};
  }
  if (index < 0 && assignment.free_by_time != 0) {
    return {.free = gains.free_mass};
  }
  return {.free = assignment.free[graded] * kUnit};
}

// Returns the masses after fusing the evidence. `c` is the conflict in a cell that was free and is
// now occupied. If the object moved into the cell, `c` is added to {M}. Otherwise, `c` is added to
// O. `x` is the conflict in a cell that was occupied and is now free. The mass `x` is added to
// ignorance.
constexpr Cell combined(const Cell& cell, const Evidence& evidence, bool moved) {
  const std::int32_t ignorance = kCertain - cell.free - cell.taken();
  const std::int32_t not_free = complement(evidence.free);
  const std::int32_t appeared = product(cell.free, evidence.occupied);
  Cell next = cell;
  next.free = product(cell.free, complement(evidence.occupied)) + product(ignorance, evidence.free);
  next.occupied = product(cell.occupied, not_free) + product(ignorance, evidence.occupied) +
                  (moved ? 0 : appeared);
  next.moving = product(cell.moving, not_free) + (moved ? appeared : 0);
  next.standing = product(cell.standing, not_free);
  return next;
}

// Returns the accumulator of a cell after fusion (Kurdej 2015, equations 5.5 and 5.6). `next`
// contains the fused masses and the old accumulator, and `conflict` is c + x.
constexpr std::int32_t persistence_of(const Cell& next, std::int32_t conflict, const Gains& gains) {
  const std::int32_t taken = next.taken();
  const std::int32_t gain =
      rounded_product(product(taken, complement(conflict)), gains.persistence);
  const std::int32_t loss = rounded_product(complement(taken), gains.decline);
  return std::clamp<std::int32_t>(next.persistence + gain - loss, 0, kCertain);
}

// Specialises a cell: a persistent cell becomes static (Kurdej 2015, equations 5.7 and 5.8). Only
// occupied sets are specialised. The mass that {M} loses is added to ignorance.
constexpr Cell specialised(const Cell& cell, const Gains& gains) {
  const std::int32_t part = product(cell.persistence, gains.specialisation);
  const std::int32_t settled = product(cell.occupied, part);
  Cell next = cell;
  next.occupied -= settled;
  next.standing += settled;
  next.moving = product(cell.moving, complement(part));
  return next;
}

// Fuses a frame's evidence into a cell, and returns the result. The cell must already be aged.
constexpr Cell fused(const Cell& cell, const Evidence& evidence, bool moved, const Gains& gains) {
  const std::int32_t conflict =
      product(cell.free, evidence.occupied) + product(cell.taken(), evidence.free);
  Cell next = combined(cell, evidence, moved);
  next.persistence = persistence_of(next, conflict, gains);
  return specialised(next, gains);
}

constexpr Cell cell_of(const Free& free, const Taken& taken, std::size_t i) {
  return {free[i], taken.occupied[i], taken.moving[i], taken.standing[i], taken.persistence[i]};
}

constexpr void put(Free& free, Taken& taken, std::size_t i, const Cell& cell) {
  free[i] = static_cast<std::int16_t>(cell.free);
  taken.occupied[i] = static_cast<std::int16_t>(cell.occupied);
  taken.moving[i] = static_cast<std::int16_t>(cell.moving);
  taken.standing[i] = static_cast<std::int16_t>(cell.standing);
  taken.persistence[i] = static_cast<std::int16_t>(cell.persistence);
}

}  // namespace iog::evidence
