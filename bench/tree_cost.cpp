// tree_cost: what the linear quadtree of a fused frame costs, for the cost model of the Cortex-A9
// (bench/measure_a9). Prints one line of key=value pairs.
//
//   tree_cost <capture> <frames>
//
// build_tree() is what is measured: every touched tile is taken out of the grid and added, the tree
// is finished. One frame more goes before, to warm up.
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <system_error>

#include "app/frame_engine.hpp"
#include "bench/a9_model/marker.hpp"
#include "capture.hpp"
#include "instruction_counter.hpp"
#include "playback.hpp"
#include "require/require.hpp"
#include "selected_vehicle.hpp"
#include "tree/quadtree_builder.hpp"

namespace iog::bench {
namespace {

[[gnu::noinline]] void build_tree(const grid::FrameFusion& fusion, tree::QuadtreeBuilder& builder) {
  builder.begin();
  std::array<grid::OccupancyIndex, grid::kTileCells> cells;
  for (std::size_t tile = 0; tile < grid::kTileCount; ++tile) {
    if (fusion.is_touched(tile) && fusion.copy_tile(tile, cells)) {
      require(builder.add(tile % grid::kTilesPerSide, tile / grid::kTilesPerSide,
                          std::as_bytes(std::span(cells))) == tree::TileFate::kAdded);
    }
  }
  builder.finish();
}

// A target of play() that builds a tree when a frame is complete.
class Trees {
 public:
  Trees(Capture& capture, std::size_t frames)
      : capture_(capture), frames_(frames), engine_(vehicles::kVehicle, kReplayer, 0) {}

  void take(const vehicle::Sensor& /*sensor*/, const app::SensorDatagram& datagram,
            std::uint32_t /*received*/, std::uint64_t now_us) {
    auto inspection = engine_.inspect(datagram);
    if (inspection == app::FrameEngine::Inspection::kNextFrame) {
      close_frame(now_us);
      inspection = engine_.inspect(datagram);
    }
    if (inspection == app::FrameEngine::Inspection::kThisFrame) {
      engine_.fuse(now_us);
    }
    if (engine_.is_complete()) {
      close_frame(now_us);
    }
  }
  void tick(std::uint64_t now_us) {
    if (engine_.is_overdue(now_us)) {
      close_frame(now_us);
    }
  }
  [[nodiscard]] std::uint64_t deadline_us() const { return engine_.deadline_us(); }

  // Of all frames but the first.
  [[nodiscard]] std::size_t frames() const { return built_ == 0 ? 0 : built_ - 1; }
  [[nodiscard]] std::uint64_t leaves() const { return leaves_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  void close_frame(std::uint64_t now_us) {
    engine_.finish();
    build_tree(engine_.fusion(), builder_);
    ++built_;
    if (built_ == 1) {
      a9_model::forget_so_far();
    } else {
      leaves_ += tree_.leaves();
      bytes_ += tree_.used_bytes();
    }
    engine_.fusion().clear();
    engine_.start_next(now_us);
    if (frames() == frames_) {
      capture_.close();
    }
  }

  Capture& capture_;
  std::size_t frames_;
  app::FrameEngine engine_;
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
  play(capture, vehicles::kVehicle, counter, trees);
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
}  // namespace iog::bench

int main(int argc, char** argv) {
  constexpr std::size_t kMostFrames = 1000;
  std::size_t frames = 0;
  if (argc == 3) {
    const char* const end = argv[2] + std::strlen(argv[2]);
    const auto [rest, fault] = std::from_chars(argv[2], end, frames);
    frames = fault == std::errc{} && rest == end && frames <= kMostFrames ? frames : 0;
  }
  if (frames == 0) {
    std::puts("tree_cost: expected a capture and a number of frames");
    return 2;
  }
  return iog::bench::run(argv[1], frames);
}
