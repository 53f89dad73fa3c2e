// stream_cost: instructions for what the stream adds to a tile on the Cortex-A9: CRC-32/P4 by the
// number of its slices, and the encodings. Runs in QEMU with instruction counting
// (lab/target/run_image):
//
//   stream_cost <grid>...    grids of frames that follow each other, as `iog fuse --out-raw` writes
//   them
//
// A tile is encoded alone and against the frame before; so are two that no drive has, as many runs
// as there are cells. Prints a line of key=value pairs for each.
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <span>

#include "checksum/reflected_crc32.hpp"
#include "grid_file.hpp"
#include "instruction_counter.hpp"
#include "tile_coding/encode.hpp"

namespace iog::lab {
namespace {

InstructionCounter counter;
Grid current;
Grid before;

void print(const char* key, std::uint64_t value) {
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf(" %s=%llu", key, value);
}

template <typename Work>
std::uint32_t instructions(Work work) {
  const std::uint32_t start = counter.now();
  work();
  return counter.now() - start - counter.of_nothing();
}

template <std::size_t kSlices>
void measure_crc() {
  static Tile bytes;
  checksum::ReflectedCrc32<0xF4ACFB13, kSlices> crc;
  const std::uint32_t count = instructions([&] { crc.update(bytes); });
  std::printf("stream_cost");
  print("crc_slices", kSlices);
  print("bytes", bytes.size());
  print("instructions", count);
  print("value", crc.value());
  std::puts("");
}

// What a set of tiles took.
struct Cost {
  const char* name;
  std::uint32_t tiles = 0;
  std::uint32_t instructions = 0;
  std::uint32_t most = 0;
  std::uint32_t bytes = 0;
  std::array<std::uint32_t, tile_coding::kEncodingCount> chosen{};

  void add(const tile_coding::EncodedTile& tile, std::uint32_t count) {
    ++tiles;
    instructions += count;
    most = std::max(most, count);
    bytes += tile.bytes;
    ++chosen[static_cast<std::size_t>(tile.encoding)];
  }

  void report() const {
    std::printf("stream_cost encode=%s", name);
    print("tiles", tiles);
    print("bytes", bytes);
    print("instructions", instructions);
    print("most", most);
    print("raw_tiles", chosen[static_cast<std::size_t>(tile_coding::Encoding::kRaw)]);
    std::puts("");
  }
};

void encode_tile(const Tile& tile, const Tile& old, Cost& alone, Cost& since) {
  static tile_coding::Encoder encoder;
  static Tile payload;
  const auto encode = [&](const std::optional<tile_coding::Reference>& reference, Cost& cost) {
    tile_coding::EncodedTile result{};
    const std::uint32_t count =
        instructions([&] { result = encoder.encode(tile, 2, reference, payload); });
    cost.add(result, count);
  };
  encode(std::nullopt, alone);
  encode(tile_coding::Reference{.cells = old, .frame_number = 1}, since);
}

void encode_grid(Cost& alone, Cost& since) {
  for (std::size_t i = 0; i < kTilesPerSide * kTilesPerSide; ++i) {
    const Tile tile = tile_of(current, i % kTilesPerSide, i / kTilesPerSide);
    if (is_known(tile)) {
      encode_tile(tile, tile_of(before, i % kTilesPerSide, i / kTilesPerSide), alone, since);
    }
  }
}

// No two neighbours in a row are equal; `values` values in turn.
Tile restless(std::size_t values, std::size_t first) {
  Tile tile;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    tile[i] = static_cast<std::byte>((i + first) % values + 1);
  }
  return tile;
}

void encode_hard_tiles() {
  for (const std::size_t values : {2U, 127U}) {
    Cost alone{.name = values == 2 ? "two_values_alone" : "many_values_alone"};
    Cost since{.name = values == 2 ? "two_values_since" : "many_values_since"};
    encode_tile(restless(values, 0), restless(values, 1), alone, since);
    alone.report();
    since.report();
  }
}

int run(std::span<char*> grids) {
  counter.start();
  if (!counter.is_exact()) {
    std::puts("stream_cost: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  measure_crc<4>();
  measure_crc<8>();
  measure_crc<16>();
  encode_hard_tiles();
  Cost alone{.name = "alone"};
  Cost since{.name = "since"};
  for (std::size_t i = 0; i < grids.size(); ++i) {
    before = current;
    if (!read(grids[i], current)) {
      return 1;
    }
    if (i > 0) {
      encode_grid(alone, since);
    }
  }
  alone.report();
  since.report();
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  return iog::lab::run(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
}
