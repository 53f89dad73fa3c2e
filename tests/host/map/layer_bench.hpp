// A town, and a window that is drawn from it frame by frame.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "fakes/random.hpp"
#include "map/flat_map.hpp"
#include "map/layer.hpp"
#include "perception/frames.hpp"

namespace iog::map {

inline constexpr BoxCm kWide = tests::box_around({0, 0}, 100'000);
inline constexpr pose::Sigma kSigma{.position_mm = 30, .heading_10urad = 60};

// Houses and roads on a lattice of 12 m, some of them with many corners.
inline tests::ReferenceBlock town(std::uint64_t seed, std::int32_t reach_cm = 9'000) {
  tests::Random random(seed);
  tests::ReferenceBlock town{.extent = kWide, .accuracy_mm = 300};
  for (std::int32_t y = -reach_cm; y < reach_cm; y += 1'200) {
    for (std::int32_t x = -reach_cm; x < reach_cm; x += 1'200) {
      const BoxCm box{{x, y}, {x + random.between(300, 1'100), y + random.between(300, 1'100)}};
      town.features.push_back(
          {random.one_in(3) ? Kind::kRoad : Kind::kBuilding, {tests::rectangle(box)}});
    }
  }
  return town;
}

// A window and a layer, frame by frame.
struct LayerBench {
  std::unique_ptr<perception::WindowFusion> window;
  std::unique_ptr<Layer> layer = std::make_unique<Layer>();
  pose::MapTransform transform{
      .origin = 0, .local_frame = {3'000, -2'000, 600'000'000}, .sigma = kSigma};

  explicit LayerBench(const WrittenBlock& map, window::Extent extent = {})
      : window(std::make_unique<perception::WindowFusion>(perception::Rules{.extent = extent})) {
    transform.origin = map.block().origin();
    window->follow({});
  }
  const LayerReport& frame(const Block* block) { return frame(block, transform); }
  const LayerReport& frame(const Block* block, const std::optional<pose::MapTransform>& by) {
    layer->work(block, by, *window);
    return layer->report();
  }
  const LayerReport& frame(const WrittenBlock& map) { return frame(&map.block()); }
  // Until no tile waits; how many frames that took.
  int settle(const WrittenBlock& map) {
    int frames = 1;
    while (frame(map).tiles_waiting > 0 && frames < 10'000) {
      ++frames;
    }
    return frames;
  }
  // Two frames in which beams go through all cells of 30 by 30 m around the vehicle.
  void free_around() {
    tests::Slice slice;
    constexpr std::int32_t kMiddle = geometry::kCellsPerSide / 2;
    for (std::int32_t y = kMiddle - 150; y < kMiddle + 150; ++y) {
      for (std::int32_t x = kMiddle - 150; x < kMiddle + 150; ++x) {
        slice.set({x, y}, -14);
      }
    }
    for (const std::uint64_t stamp_us : {1'000'000U, 1'100'000U}) {
      perception::add_slice(slice, perception::at_cell({}), *window);
      window->finish(stamp_us);
    }
  }
  void go_to(std::int32_t x_m, std::int32_t y_m) { window->follow({1000 * x_m, 1000 * y_m, 0}); }

  [[nodiscard]] bool is_anything(std::size_t slot) const {
    return window->view().tile(slot).ruled_out == window::TileRuledOut{};
  }
  [[nodiscard]] std::vector<bool> anything() const {
    std::vector<bool> slots;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      slots.push_back(is_anything(slot));
    }
    return slots;
  }
  [[nodiscard]] std::size_t masks() const {
    return static_cast<std::size_t>(std::ranges::count(anything(), false));
  }
  // All masks, by slot.
  [[nodiscard]] std::vector<TileClasses> classes() const {
    std::vector<TileClasses> tiles;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      tiles.push_back(classes_of(window->view().tile(slot).ruled_out));
    }
    return tiles;
  }
  [[nodiscard]] TilePlace place(std::size_t slot) const {
    return {transform.local_frame, window->view().area().tile_at(slot)};
  }
};

}  // namespace iog::map
