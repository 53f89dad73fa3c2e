// tree_cost: what the linear quadtree of a fused frame costs, for the cost model of the Cortex-A9
// (lab/target/measure_a9). Prints one line of key=value pairs.
//
//   tree_cost <capture> <frames>
//
// build_tree() is what is measured: every touched tile is taken out of the grid and added, the tree
// is finished. One frame more goes before, to warm up.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

#include "capture.hpp"
#include "fused_frames.hpp"
#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "lab/tree/quadtree_builder.hpp"
#include "number_in.hpp"
#include "playback.hpp"
#include "require/require.hpp"
#include "vehicles/cars.hpp"

namespace iog::lab {
namespace {

[[gnu::noinline]] void build_tree(const grid::BlockGrid& frame, tree::QuadtreeBuilder& builder) {
  builder.begin();
  std::array<grid::OccupancyIndex, geometry::kTileCells> cells;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (frame.is_touched(tile) && frame.copy_tile(tile, cells)) {
      require(builder.add(tile % geometry::kTilesPerSide, tile / geometry::kTilesPerSide,
                          std::as_bytes(std::span(cells))) == tree::TileFate::kAdded);
    }
  }
  builder.finish();
}

// Builds the tree of each frame, and adds up what they are, but for the first.
class Trees {
 public:
  Trees(Capture& capture, std::size_t frames) : capture_(capture), frames_(frames) {}

  void build(const grid::BlockGrid& frame) {
    build_tree(frame, builder_);
    ++built_;
    if (built_ == 1) {
      a9_model::forget_so_far();
    } else {
      leaves_ += tree_.leaves();
      bytes_ += tree_.used_bytes();
    }
    if (frames() == frames_) {
      capture_.close();
    }
  }

  [[nodiscard]] std::size_t frames() const { return built_ == 0 ? 0 : built_ - 1; }
  [[nodiscard]] std::uint64_t leaves() const { return leaves_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  Capture& capture_;
  std::size_t frames_;
  std::array<std::byte, tree::kWorstLeafBytes> memory_{};
  tree::LinearQuadtree tree_{memory_};
  tree::QuadtreeBuilder builder_{tree_};
  std::size_t built_ = 0;
  std::uint64_t leaves_ = 0;
  std::uint64_t bytes_ = 0;
};

int run(const char* path, std::size_t frames) {
  static InstructionCounter counter;
  static Capture capture;
  static Trees trees(capture, frames);
  counter.start();
  if (!capture.open(path)) {
    std::printf("tree_cost: %s cannot be read as a pcap of Ethernet frames\n", path);
    return 1;
  }
  const auto build = [](const grid::BlockGrid& frame) { trees.build(frame); };
  static FusedFrames fused(vehicles::cars()[0].vehicle, build);
  play(capture, vehicles::cars()[0].vehicle, counter, fused);
  if (trees.frames() < frames) {
    std::puts("tree_cost: the capture has not so many frames");
    return 1;
  }
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf("tree_cost frames=%u leaves=%llu bytes=%llu\n", frames, trees.leaves(),
              trees.bytes());
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  constexpr std::size_t kMostFrames = 1000;
  const std::size_t frames = argc == 3 ? iog::lab::number_in(argv[2], kMostFrames) : 0;
  if (frames == 0) {
    std::puts("tree_cost: expected a capture and a number of frames");
    return 2;
  }
  return iog::lab::run(argv[1], frames);
}
