#include "grid/carve_run.hpp"

#include <array>

namespace iog::grid {

// Not inlined, so that the loop stays in registers. The stride is looked up, which is done long
// before the block is needed.
[[gnu::noinline]] void carve_run(Way& way, std::uint32_t count, Lanes amount) {
  const std::array<std::ptrdiff_t, 2> strides{way.strides.u * std::ptrdiff_t{sizeof(LaneBytes)},
                                              way.strides.v * std::ptrdiff_t{sizeof(LaneBytes)}};
  const LaneBytes* const masks = way.masks;
  auto* block = reinterpret_cast<std::byte*>(way.block);
  std::uint32_t code = way.code;
  const auto carve_next = [&](BlockCode next) {
    block += strides[code & 1U];
    code = next;
    carve_block(*reinterpret_cast<LaneBytes*>(block), Lanes::load(masks[code / 2U]), amount);
  };
  const BlockCode* next = way.next_codes;
  const BlockCode* const end = next + count;
  for (; end - next >= 4; next += 4) {
    carve_next(next[0]);
    carve_next(next[1]);
    carve_next(next[2]);
    carve_next(next[3]);
  }
  for (; next != end; ++next) {
    carve_next(*next);
  }
  way.block = reinterpret_cast<LaneBytes*>(block);
  way.code = code;
  way.next_codes = next;
}

}  // namespace iog::grid
