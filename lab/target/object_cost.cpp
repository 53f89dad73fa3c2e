// object_cost: what following things costs the Cortex-A9 in frames that are forged to be dear, for
// lab/target/run_image and for the cost model. Prints one line of key=value pairs.
//
//   object_cost <kind> <frames>
//
// Kinds, of which the grid calls all hits moving:
//   anywhere  16,384 hits anywhere in the window
//   things    1,024 things of 4 hits, which move by 5 m/s
//   walls     40 walls of 400 hits, parallel to the way
//   crowd     400 things of 10 hits, which overlap, around the car
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "number_in.hpp"
#include "objects/tracker.hpp"

namespace iog::lab {
namespace {

constexpr std::size_t kMostHits = 16'384;
constexpr std::size_t kWarmUp = 12;
constexpr std::int32_t kReach = 16 * window::kTileSide;  // of the window
constexpr std::uint64_t kFrameUs = 40'000;
constexpr std::uint64_t kBeginUs = 50'000'000;
constexpr std::array<std::uint8_t, 5> kAgesMs{32, 24, 16, 8, 0};

// Anything is called moving, on ground that was open.
struct Moving {
  [[nodiscard]] static objects::CellName look_at(geometry::Cell /*cell*/) {
    return {.name = objects::Name::kMoving, .is_open = true};
  }
  [[nodiscard]] static objects::Names names_around(geometry::Cell /*cell*/) {
    return objects::Names(1U << static_cast<unsigned>(decision::Class::kMoving));
  }
};

// Numerical Recipes' generator: which numbers does not matter, but they are the same everywhere.
class Numbers {
 public:
  std::int32_t between(std::int32_t low, std::int32_t high) {
    state_ = state_ * 1'664'525 + 1'013'904'223;
    return low +
           static_cast<std::int32_t>((state_ >> 8) % static_cast<std::uint32_t>(high - low + 1));
  }

 private:
  std::uint32_t state_ = 7;
};

class Frames {
 public:
  explicit Frames(std::string_view kind) : kind_(kind) {
    for (geometry::Cell& place : places_) {
      place = {numbers_.between(-400, 400), numbers_.between(-400, 400)};
    }
  }

  std::span<const objects::Hit> next() {
    count_ = 0;
    if (kind_ == "anywhere") {
      anywhere();
    } else if (kind_ == "things") {
      things();
    } else if (kind_ == "walls") {
      walls();
    } else if (kind_ == "crowd") {
      crowd();
    }
    ++frame_;
    return std::span(hits_).first(count_);
  }

 private:
  void put(std::int32_t x, std::int32_t y, std::size_t slice) {
    hits_[count_++] = {.cell = {x, y}, .slice = static_cast<std::uint8_t>(slice)};
  }

  void anywhere() {
    while (count_ < kMostHits) {
      put(numbers_.between(-kReach, kReach - 1), numbers_.between(-kReach, kReach - 1), 4);
    }
  }
  void things() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const std::int32_t way = (i % 2 == 0 ? -2 : 2) * frame_;
      for (std::int32_t n = 0; n < 4; ++n) {
        put(places_[i].x + way + n % 2, places_[i].y + n / 2, 4);
      }
    }
  }
  void walls() {
    for (std::int32_t wall = 0; wall < 40; ++wall) {
      for (std::int32_t x = -200; x < 200; ++x) {
        put(x, 10 * (wall - 20) + frame_ % 2, 4);
      }
    }
  }
  void crowd() {
    for (std::int32_t i = 0; i < 400; ++i) {
      const std::int32_t off = numbers_.between(-3, 3) + frame_ % 2;
      for (std::int32_t n = 0; n < 10; ++n) {
        put(off + i % 20 * 7 + n % 2, i / 20 * 7 + n / 2 % 2, static_cast<std::size_t>(n % 5));
      }
    }
  }

  std::string_view kind_;
  Numbers numbers_;
  std::int32_t frame_ = 0;
  std::array<geometry::Cell, 1'024> places_{};
  std::size_t count_ = 0;
  std::array<objects::Hit, kMostHits> hits_{};
};

int run(std::string_view kind, std::size_t frames) {
  static InstructionCounter counter;
  counter.start();
  static Frames forged(kind);
  static objects::Tracker tracker;
  const Moving moving;
  std::uint32_t sum = 0;
  std::uint32_t most = 0;
  std::size_t hits = 0;
  for (std::size_t frame = 0; frame < kWarmUp + frames; ++frame) {
    const objects::Frame next{.end_us = kBeginUs + kFrameUs * frame,
                              .area = window::Area::around({0, 0}),
                              .ages_ms = kAgesMs,
                              .hits = forged.next()};
    const std::uint32_t start = counter.now();
    tracker.add(next, objects::GridNames(moving));
    const std::uint32_t cost = counter.now() - start - counter.of_nothing();
    if (frame < kWarmUp) {
      a9_model::forget_so_far();
      continue;
    }
    a9_model::end_round();
    hits = next.hits.size();
    sum += cost;
    most = cost > most ? cost : most;
  }
  if (!counter.is_exact() || hits == 0) {
    std::puts("object_cost: no such kind, or instructions are not counted");
    return 1;
  }
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC they would be unsigned int
  std::printf("object_cost kind=%s frames=%u hits=%u bytes=%u objects_sum=%lu objects_max=%lu\n",
              kind.data(), frames, hits, sizeof(objects::Tracker), sum, most);
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  using iog::lab::number_in;
  constexpr std::size_t kMostFrames = 1'000;
  if (argc != 3 || number_in(argv[2], kMostFrames) == 0) {
    std::puts("object_cost: expected a kind of frames and how many of them");
    return 2;
  }
  return iog::lab::run(argv[1], number_in(argv[2], kMostFrames));
}
