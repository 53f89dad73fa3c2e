#include "grid/carving.hpp"

#include <algorithm>

#include "traversal/walk.hpp"

namespace iog::grid {
namespace {

// More than that is no more: any cell of a beam was 0 or below.
std::int8_t amount_of(std::int32_t freer) {
  return static_cast<std::int8_t>(std::min<std::int32_t>(freer, index::kIndexMax<OccupancyIndex>));
}

void carve_block(LaneBytes& block, Lanes cells, Lanes amount) {
  Lanes::load(block).subtract(amount.masked(cells)).store(block);
}

// A way through blocks: where it is, the code of that block, and the codes of the next.
struct Way {
  BlockRun run;
  LaneBytes* block;
  std::uint32_t code;
  const BlockCode* next_codes;

  // From this block to the next, in blocks as stored.
  [[nodiscard]] std::ptrdiff_t stride() const {
    return (code & 1U) != 0 ? run.v_stride : run.u_stride;
  }
  void step() {
    block += stride();
    code = *next_codes;
    ++next_codes;
  }
};

// The next `count` blocks of the way.
void carve_one_by_one(Way& way, std::uint32_t count, Lanes amount) {
  for (; count > 0; --count) {
    way.step();
    carve_block(*way.block, Lanes::load(way.run.masks[way.code / 2U]), amount);
  }
}

#if defined(__ARM_NEON) && defined(__arm__)

// The next four times `fours` blocks of the way, fours > 0: what carve_one_by_one() does to them.
//
// The codes of four blocks are one word. A line never comes back to a block, so all four are loaded
// before the first is stored. Written by hand, because the compiler runs out of registers and needs
// a third more instructions for it.
void carve_fours(Way& way, std::uint32_t fours, Lanes amount) {
  constexpr std::ptrdiff_t kBlockBytes = sizeof(LaneBytes);
  LaneBytes* a = way.block + way.stride();
  LaneBytes* b = nullptr;
  LaneBytes* c = nullptr;
  LaneBytes* d = nullptr;
  std::uint32_t word = 0;
  std::uint32_t shape = 0;
  const BlockCode* codes = way.next_codes;
  const BlockCode* const end = codes + 4 * fours;
  asm volatile(
      "1:\n"
      "  ldr   %[word], [%[codes]], #4\n"
      "  tst   %[word], #0x1\n"
      "  ubfx  %[shape], %[word], #1, #7\n"
      "  addeq %[b], %[a], %[u]\n"
      "  addne %[b], %[a], %[v]\n"
      "  add   %[shape], %[masks], %[shape], lsl #4\n"
      "  vld1.64 {d16-d17}, [%[shape] :128]\n"
      "  tst   %[word], #0x100\n"
      "  ubfx  %[shape], %[word], #9, #7\n"
      "  addeq %[c], %[b], %[u]\n"
      "  addne %[c], %[b], %[v]\n"
      "  add   %[shape], %[masks], %[shape], lsl #4\n"
      "  vld1.64 {d18-d19}, [%[shape] :128]\n"
      "  tst   %[word], #0x10000\n"
      "  ubfx  %[shape], %[word], #17, #7\n"
      "  addeq %[d], %[c], %[u]\n"
      "  addne %[d], %[c], %[v]\n"
      "  add   %[shape], %[masks], %[shape], lsl #4\n"
      "  vld1.64 {d20-d21}, [%[shape] :128]\n"
      "  lsr   %[shape], %[word], #25\n"
      "  add   %[shape], %[masks], %[shape], lsl #4\n"
      "  vld1.64 {d22-d23}, [%[shape] :128]\n"
      "  vld1.64 {d24-d25}, [%[a] :128]\n"
      "  vand  q8, q8, %q[amount]\n"
      "  vld1.64 {d26-d27}, [%[b] :128]\n"
      "  vand  q9, q9, %q[amount]\n"
      "  vld1.64 {d28-d29}, [%[c] :128]\n"
      "  vand  q10, q10, %q[amount]\n"
      "  vld1.64 {d30-d31}, [%[d] :128]\n"
      "  vand  q11, q11, %q[amount]\n"
      "  vqsub.s8 q12, q12, q8\n"
      "  vqsub.s8 q13, q13, q9\n"
      "  vqsub.s8 q14, q14, q10\n"
      "  vst1.64 {d24-d25}, [%[a] :128]\n"
      "  vqsub.s8 q15, q15, q11\n"
      "  vst1.64 {d26-d27}, [%[b] :128]\n"
      "  tst   %[word], #0x1000000\n"
      "  vst1.64 {d28-d29}, [%[c] :128]\n"
      "  addeq %[a], %[d], %[u]\n"
      "  addne %[a], %[d], %[v]\n"
      "  vst1.64 {d30-d31}, [%[d] :128]\n"
      "  cmp   %[codes], %[end]\n"
      "  bne   1b\n"
      : [a] "+&r"(a), [b] "=&r"(b), [c] "=&r"(c), [d] "=&r"(d), [codes] "+&r"(codes),
        [word] "=&r"(word), [shape] "=&r"(shape)
      : [end] "r"(end), [masks] "r"(way.run.masks), [u] "r"(way.run.u_stride * kBlockBytes),
        [v] "r"(way.run.v_stride * kBlockBytes), [amount] "w"(amount.native())
      : "q8", "q9", "q10", "q11", "q12", "q13", "q14", "q15", "cc", "memory");
  way.block = d;
  way.code = word >> 24;
  way.next_codes = codes;
}

void carve_run(Way& way, std::uint32_t count, Lanes amount) {
  if (count >= 4) {
    carve_fours(way, count / 4, amount);
  }
  carve_one_by_one(way, count % 4, amount);
}

#else

void carve_run(Way& way, std::uint32_t count, Lanes amount) {
  carve_one_by_one(way, count, amount);
}

#endif

}  // namespace

// A block in which something changes is carved once: with what holds where the line enters it, and
// from each change on with what holds then.
void carve_blocks(BlockGrid& grid, BlockPath& path, const FreeSteps& steps) {
  const std::span<const FreeSteps::Change> changes = steps.changes();
  const std::uint32_t last_block = path.block_at(changes.back().at);
  path.extend_to(last_block);
  path.for_each_tile(last_block, [&](std::size_t tile) { grid.touch(tile); });

  const std::size_t quadrant = path.orientation().quadrant();
  const InnerMasks& from = kFromMasks[quadrant];
  const InnerMasks& after = kAfterMasks[quadrant];
  std::int32_t freer = steps.from_start();
  Lanes amount = Lanes::all(amount_of(freer));
  const auto carve_run_to = [&](std::uint32_t block, LaneBytes* at, std::uint32_t end) {
    if (freer > 0 && block + 1 < end) {
      const BlockRun run = path.run_from(block);
      Way way{run, at, *run.code, run.code + 1};
      carve_run(way, end - block - 1, amount);
    }
  };
  std::uint32_t number = path.block_at(changes.front().at);
  if (freer > 0 && number > 0) {
    LaneBytes* const first = grid.block_at(path.start_offset());
    carve_block(*first, Lanes::load(path.cells(0)), amount);
    carve_run_to(0, first, number);
  }
  const FreeSteps::Change* change = changes.data();
  const FreeSteps::Change* const end = change + changes.size();
  while (change != end) {
    const std::uint32_t this_block = number;
    std::uint32_t offset = 0;
    Lanes in_block = amount;
    do {
      offset = path.offset_at(change->at);
      freer += change->freer;
      amount = Lanes::all(amount_of(freer));
      const InnerMasks& masks = change->crossed > change->at.crossed() ? after : from;
      const Lanes rest = Lanes::load(masks[offset % kLaneCount]);
      in_block = in_block.without(rest).united(amount.masked(rest));
      ++change;
      number = change != end ? path.block_at(change->at) : 0;
    } while (change != end && number == this_block);
    LaneBytes* const block = grid.block_at(offset);
    carve_block(*block, Lanes::load(path.cells(this_block)), in_block);
    if (change != end) {
      carve_run_to(this_block, block, number);
    }
  }
}

void carve_cells(BlockGrid& grid, const vehicle::BeamLine& line, traversal::Position first,
                 const FreeSteps& steps) {
  traversal::Walk walk(line, first, kStride);
  std::int32_t freer = steps.from_start();
  for (const FreeSteps::Change& change : steps.changes()) {
    if (freer == 0) {
      walk.skip_until(change.crossed);
    } else {
      walk.until(change.crossed, [&](std::size_t number) {
        const traversal::Cell cell = cell_of(number);
        OccupancyIndex& index = grid.cell_at(offset_of(cell));
        index = index::sat_lower(index, -freer);
        grid.touch(tile_of(cell));
      });
    }
    freer += change.freer;
  }
}

}  // namespace iog::grid
