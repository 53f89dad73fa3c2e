// map_cost: what the map's layer costs the Cortex-A9 while a car drives at 30 m/s over a map, for
// lab/target/run_image and for the cost model. Prints one line of key=value pairs.
//
//   map_cost <block> <frames> <east> <north>
//
// The car begins at that place of the map's plane, in metres from 100 km west and south of its
// origin, and drives slantwise. First it stands until all tiles of the window are drawn; then
// frames are measured, of 1.2 m each.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "map/layer.hpp"
#include "number_in.hpp"

namespace iog::lab {
namespace {

constexpr std::int32_t kStepMm = 1'200;

std::span<const std::uint8_t> read_block(const char* path) {
  static std::array<std::uint8_t, map::kMaxBlockBytes> bytes;
  std::FILE* const file = std::fopen(path, "rb");
  if (file == nullptr) {
    return {};
  }
  const std::size_t size = std::fread(bytes.data(), 1, bytes.size(), file);
  std::fclose(file);
  return std::span(bytes).first(size);
}

struct Totals {
  std::uint32_t instructions = 0;
  std::uint32_t most = 0;  // in a frame
  std::uint32_t tiles = 0;
  std::uint32_t most_tiles = 0;
  std::uint32_t most_waiting = 0;
  std::uint32_t work = 0;
};

class Drive {
 public:
  // begin: where the local frame is in the map's plane.
  Drive(const map::Block& block, const pose::Pose& begin, InstructionCounter& counter)
      : block_(block),
        counter_(counter),
        transform_{.origin = block.origin(),
                   .local_frame = begin,
                   .sigma = {.position_mm = 50, .heading_10urad = 40}} {}

  // One frame, and what it cost.
  void frame(std::int32_t step_mm, Totals& totals) {
    window_.follow({x_mm_, 0, 0});
    x_mm_ += step_mm;
    const std::uint32_t start = counter_.now();
    layer_.work(&block_, transform_, window_);
    const std::uint32_t cost = counter_.now() - start - counter_.of_nothing();
    const map::LayerReport& report = layer_.report();
    totals.instructions += cost;
    totals.most = std::max(totals.most, cost);
    totals.tiles += report.tiles_finished;
    totals.most_tiles = std::max<std::uint32_t>(totals.most_tiles, report.tiles_finished);
    totals.most_waiting = std::max<std::uint32_t>(totals.most_waiting, report.tiles_waiting);
    totals.work += report.work;
  }

  [[nodiscard]] const map::LayerReport& report() const { return layer_.report(); }

 private:
  map::Block block_;
  InstructionCounter& counter_;
  pose::MapTransform transform_;
  perception::WindowFusion window_;
  map::Layer layer_;
  std::int32_t x_mm_ = 0;
};

int run(const char* path, std::size_t frames, const pose::Pose& begin) {
  static InstructionCounter counter;
  counter.start();
  const std::span<const std::uint8_t> bytes = read_block(path);
  if (!counter.is_exact() || map::check(bytes) != map::Refusal::kNone) {
    std::puts("map_cost: no sound block, or instructions are not counted");
    return 1;
  }
  static Drive drive(map::Block(bytes), begin, counter);
  Totals before;
  do {
    drive.frame(0, before);
  } while (drive.report().tiles_waiting > 0);
  a9_model::forget_so_far();
  Totals totals;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    drive.frame(kStepMm, totals);
    a9_model::end_round();
  }
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC they would be unsigned int
  std::printf(
      "map_cost frames=%u radius=%u layer_bytes=%u cause=%u settle_instructions=%lu "
      "settle_tiles=%lu layer_sum=%lu layer_max=%lu tiles=%lu most_tiles=%lu most_waiting=%lu "
      "work=%lu\n",
      frames, drive.report().radius, sizeof(map::Layer),
      static_cast<unsigned>(drive.report().cause), before.instructions, before.tiles,
      totals.instructions, totals.most, totals.tiles, totals.most_tiles, totals.most_waiting,
      totals.work);
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  using iog::lab::number_in;
  constexpr std::size_t kMostFrames = 10'000;
  constexpr std::size_t kMostMetres = 200'000;
  if (argc != 5 || number_in(argv[2], kMostFrames) == 0) {
    std::puts("map_cost: expected a block, a number of frames, and where to begin");
    return 2;
  }
  const auto mm = [argv](int argument) {
    return (static_cast<std::int32_t>(number_in(argv[argument], kMostMetres)) - 100'000) * 1'000;
  };
  return iog::lab::run(argv[1], number_in(argv[2], kMostFrames), {mm(3), mm(4), 400'000'000});
}
