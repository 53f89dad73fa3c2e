// serial_cost: instructions that the serial link costs the Cortex-A9.
// Runs in QEMU with instruction counting (lab/target/run_image):
//
//   serial_cost <grid>...    grids of frames that follow each other, as `iog fuse --out-raw` writes
//   them
//
// A frame comes every 40 ms and a pass of the loop every millisecond, for a minute; the grids come
// one after the other, again and again. Prints lines of key=value pairs: what handing a frame over
// and a pass took, in instructions, and how many bytes went over the line.
#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <utility>
#include <vector>

#include "grid_file.hpp"
#include "instruction_counter.hpp"
#include "serial/grid_sender.hpp"

namespace iog::lab {
namespace {

constexpr std::uint32_t kFrames = 1500;
constexpr std::uint32_t kPassesPerFrame = 40;
constexpr std::uint64_t kPassUs = 1000;

InstructionCounter counter;
serial::GridSender sender;

void print(const char* key, std::uint64_t value) {
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf(" %s=%llu", key, value);
}

struct Cost {
  std::uint64_t sum = 0;
  std::uint32_t count = 0;
  std::uint32_t most = 0;

  template <typename Work>
  void measure(Work work) {
    const std::uint32_t start = counter.now();
    work();
    const std::uint32_t instructions = counter.now() - start - counter.of_nothing();
    sum += instructions;
    ++count;
    most = std::max(most, instructions);
  }
  void print_as(const char* name) const {
    std::printf("serial_cost of=%s", name);
    print("count", count);
    print("instructions_mean", sum / std::max<std::uint32_t>(count, 1));
    print("instructions_max", most);
    std::puts("");
  }
};

// Takes what is written, and says how much it was. What the line carries of a grid is the same on a
// PC (lab/experiments/stream/serial_rounds.hpp).
class Line {
 public:
  [[nodiscard]] std::uint32_t bytes_per_second() const { return 11'520; }
  [[nodiscard]] std::size_t free_bytes() const { return 4096; }
  void write(std::span<const std::byte> bytes) {
    std::ranges::copy(bytes, written_.begin() + static_cast<std::ptrdiff_t>(written_bytes_));
    written_bytes_ += bytes.size();
  }
  void pump() {}

  // After each pass: how many bytes it has written.
  std::size_t take_written() { return std::exchange(written_bytes_, 0); }

 private:
  std::array<std::byte, 1024> written_{};
  std::size_t written_bytes_ = 0;
};

Line line;

struct KnownTile {
  std::size_t number;
  Tile cells;
};

std::vector<KnownTile> known_tiles_of(const Grid& grid) {
  std::vector<KnownTile> tiles;
  for (std::size_t i = 0; i < kTilesPerSide * kTilesPerSide; ++i) {
    const Tile tile = tile_of(grid, i % kTilesPerSide, i / kTilesPerSide);
    if (is_known(tile)) {
      tiles.push_back({.number = i, .cells = tile});
    }
  }
  return tiles;
}

void hand_over(std::uint32_t frame, const std::vector<KnownTile>& tiles, Cost& cost) {
  cost.measure([&] {
    sender.begin_frame({.frame_number = frame, .complete_sensors = 1});
    for (const KnownTile& tile : tiles) {
      sender.take_tile(tile.number, tile.cells);
    }
    sender.end_frame();
  });
}

int run(std::span<char*> names) {
  counter.start();
  if (!counter.is_exact()) {
    std::puts("serial_cost: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  static Grid grid;
  std::vector<std::vector<KnownTile>> grids;
  for (const char* const name : names) {
    if (!read(name, grid)) {
      return 1;
    }
    grids.push_back(known_tiles_of(grid));
  }
  Cost frame_cost;
  Cost pass_cost;
  std::uint64_t line_bytes = 0;
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    hand_over(frame, grids[frame % grids.size()], frame_cost);
    for (std::uint64_t pass = 0; pass < kPassesPerFrame; ++pass) {
      const std::uint64_t now_us = (frame * std::uint64_t{kPassesPerFrame} + pass) * kPassUs;
      pass_cost.measure([&] { sender.pump(now_us, line); });
      line_bytes += line.take_written();
    }
  }
  frame_cost.print_as("frame");
  pass_cost.print_as("pass");
  std::printf("serial_cost of=line");
  print("bytes", line_bytes);
  std::puts("");
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  return iog::lab::run(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
}
