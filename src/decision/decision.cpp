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

std::array<FreeBits, 2> cross_free(const std::array<Crossed, 2>& groups) {
  std::array<FreeBits, 2> bits;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Crossed& group = groups[i];
    evidence::fuse_free(*group.free, *group.fading, *group.indexes, *group.gains);
    bits[i] = decide_free(*group.free, *group.ruled_out, *group.indexes, *group.decided);
  }
  return bits;
}

}  // namespace iog::decision
