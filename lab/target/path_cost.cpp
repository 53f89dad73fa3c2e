// path_cost: instructions a block on the Cortex-A9, to find it on the path of a line and to carve
// it (docs/carving.md). Runs in QEMU with instruction counting (lab/target/run_image); prints a
// line of key=value pairs. Lines of 50 m in all directions, from a point inside a cell in the
// grid's middle.
#include <cstdint>
#include <cstdio>

#include "grid/block_grid.hpp"
#include "grid/block_path.hpp"
#include "grid/carve_run.hpp"
#include "instruction_counter.hpp"
#include "numeric/sine_table.hpp"
#include "traversal/corner.hpp"

namespace iog::lab {
namespace {

constexpr std::uint32_t kDirections = 720;
// So many blocks of each line are found and carved, and so many more. The difference is what blocks
// cost without what each call does besides.
constexpr std::uint32_t kFew = 20;
constexpr std::uint32_t kMany = 80;

constexpr std::int64_t kLongSubcells =
    std::int64_t{50'000} / geometry::kCellMm * geometry::kResolution;
constexpr std::int32_t kStart = geometry::kOriginCell * geometry::kResolution;

struct PathCost {
  std::uint64_t lines = 0;
  std::uint64_t blocks = 0;
  std::uint64_t find = 0;   // instructions
  std::uint64_t carve = 0;  // instructions
};

vehicle::BeamLine line_to(std::uint32_t direction) {
  constexpr numeric::SineTable kTable = numeric::kSineTable<kDirections>;
  const traversal::SubcellPoint start{kStart + geometry::kResolution / 3,
                                      kStart + geometry::kResolution / 5};
  const auto along = [](std::int64_t unit) {
    return static_cast<std::int32_t>((kLongSubcells * unit) >> numeric::kSineFractionBits);
  };
  return {start,
          {start.x + along(kTable.cosine(direction)), start.y + along(kTable.sine(direction))}};
}

template <typename Work>
std::uint32_t instructions_of(InstructionCounter& counter, Work&& work) {
  const std::uint32_t before = counter.now();
  work();
  return counter.now() - before - counter.of_nothing();
}

void measure(InstructionCounter& counter, const vehicle::BeamLine& line, PathCost& cost) {
  static grid::BlockGrid grid;
  static grid::BlockPath path;
  const auto find = [&](std::uint32_t blocks) {
    return instructions_of(counter, [&] { path.find_up_to(blocks); });
  };
  const auto carve = [&](std::uint32_t blocks) {
    grid::Way way = path.way_from(grid.block_at(path.start_offset()),
                                  grid.strides(path.orientation().number()).blocks);
    return instructions_of(counter, [&] { grid::carve_run(way, blocks, lanes::Lanes::all(1)); });
  };
  path.begin(line, grid);
  const std::uint32_t few = find(kFew);
  cost.find += find(kFew + kMany) - few;
  cost.carve += carve(kMany) - carve(kFew);
  cost.blocks += kMany - kFew;
  ++cost.lines;
}

int run() {
  static InstructionCounter counter;
  counter.start();
  if (!counter.is_exact()) {
    std::puts("path_cost: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  PathCost cost;
  for (std::uint32_t direction = 0; direction < kDirections; ++direction) {
    const vehicle::BeamLine line = line_to(direction);
    if (!traversal::may_meet_corner(line)) {
      measure(counter, line, cost);
    }
  }
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf("path_cost lines=%llu blocks=%llu find_instructions=%llu carve_instructions=%llu\n",
              cost.lines, cost.blocks, cost.find, cost.carve);
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main() { return iog::lab::run(); }
