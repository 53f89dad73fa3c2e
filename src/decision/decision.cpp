#include "decision/decision.hpp"

#include <cstddef>

#include "decision/cell.hpp"
#include "evidence/cell.hpp"
#include "evidence/fusion.hpp"

namespace iog::decision {
namespace {

constexpr std::uint8_t bit(bool is_set, std::size_t cell) {
  return static_cast<std::uint8_t>(std::uint32_t{is_set} << cell);
}

}  // namespace

Bits decide(const evidence::Free& free, const evidence::Taken& taken, const RuledOut& ruled_out,
            const evidence::Indexes& of_this_frame, Decided& decided) {
  Bits bits;
  for (std::size_t i = 0; i < evidence::kGroupCells; ++i) {
    const evidence::Cell cell = evidence::cell_of(free, taken, i);
    decided[i] = byte_of(verdict(cell, mask_of(ruled_out[i])));
    bits.freed |= bit(cell.free > kFreedAbove, i);
    bits.seen |= bit(of_this_frame[i] < 0 && cell.free > kSeenAbove, i);
    bits.stands |= bit(cell.persistence > kStandsAbove, i);
    bits.taken |= bit(cell.taken() > kTakenAbove, i);
    bits.held |= bit(cell.taken() > 0 || cell.persistence > 0, i);
  }
  return bits;
}

FreeBits decide_free(const evidence::Free& free, const RuledOut& ruled_out,
                     const evidence::Indexes& of_this_frame, Decided& decided) {
  const Bits bits = decide(free, evidence::Taken{}, ruled_out, of_this_frame, decided);
  return {.freed = bits.freed, .seen = bits.seen};
}

template <std::size_t kGroups>
std::uint64_t cross_free(const Crossed& groups) {
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < kGroups; ++i) {
    evidence::Free& free = groups.free[i];
    evidence::fuse_free(free, *groups.fading, groups.indexes[i], *groups.gains);
    const FreeBits bits =
        decide_free(free, groups.ruled_out[i], groups.indexes[i], groups.decided[i]);
    all |= (std::uint64_t{bits.freed} | std::uint64_t{bits.seen} << 32) << (8 * i);
  }
  return all;
}
template std::uint64_t cross_free<2>(const Crossed& groups);
template std::uint64_t cross_free<4>(const Crossed& groups);

}  // namespace iog::decision
